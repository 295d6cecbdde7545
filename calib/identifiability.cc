#include "calib/identifiability.h"

#include <glog/logging.h>

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kExcited = 1e-8;  // relative to the direction seen best

std::string DirectionText(const VectorXd& x, const VectorXd& y,
                          const ModelParameters& parameters) {
  std::string text, only;
  int terms = 0;
  const double largest = y.cwiseAbs().maxCoeff();
  for (int c = 0; c < x.size(); ++c) {
    if (std::abs(y[c]) < 0.05 * largest) continue;
    char factor[32];
    std::snprintf(factor, sizeof(factor), "%.2f ", std::abs(x[c]));
    if (text.empty()) {
      text = x[c] < 0 ? "-" : "";
    } else {
      text += x[c] < 0 ? " - " : " + ";
    }
    only = parameters.parameters()[c].name;
    text += factor + only;
    ++terms;
  }
  return terms == 1 ? only : text;
}

UnidentifiableDirection MakeDirection(const VectorXd& y, const VectorXd& scale,
                                      int begin, int block,
                                      const ModelParameters& parameters) {
  VectorXd full_y = VectorXd::Zero(parameters.size());
  full_y.segment(begin, y.size()) = y;
  UnidentifiableDirection d;
  d.block = block;
  d.x = VectorXd::Zero(parameters.size());
  d.x.segment(begin, y.size()) = y.cwiseQuotient(scale);
  // Normalised and signed by the entry that matters most.
  Eigen::Index lead;
  d.x.cwiseAbs().maxCoeff(&lead);
  d.x /= d.x[lead];
  d.text = DirectionText(d.x, full_y, parameters);
  return d;
}

// Of a system with unit noise in coordinates relative to the joint's torque: a
// singular value below 1 leaves more than the whole torque undecided.
int Rank(const VectorXd& s) {
  int rank = 0;
  for (const double x : s) {
    if (x > 1 && x > kExcited * s[0]) ++rank;
  }
  return rank;
}

// Another basis of the space that the columns of N span, in which each vector
// has one coordinate for its own (reduced echelon form with full pivoting, in
// the order of these coordinates): what cannot be seen of a joint at rest then
// reads as three parameters, not as three mixtures of them.
MatrixXd EchelonBasis(const MatrixXd& N) {
  MatrixXd rows = N.transpose();
  std::vector<std::pair<Eigen::Index, Eigen::Index>> pivots;  // column, row
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    Eigen::Index r, c;
    rows.bottomRows(rows.rows() - k).cwiseAbs().maxCoeff(&r, &c);
    rows.row(k).swap(rows.row(k + r));
    rows.row(k) /= rows(k, c);
    for (Eigen::Index other = 0; other < rows.rows(); ++other) {
      if (other == k) continue;
      const double factor = rows(other, c);
      rows.row(other) -= factor * rows.row(k);
    }
    pivots.emplace_back(c, k);
  }
  std::sort(pivots.begin(), pivots.end());
  MatrixXd basis(N.rows(), N.cols());
  for (size_t k = 0; k < pivots.size(); ++k) {
    basis.col(k) = rows.row(pivots[k].second).transpose();
  }
  return basis;
}

// rms of the columns of U over random states.
MatrixXd RichColumns(const ModelParameters& parameters, double speed,
                     double hz) {
  const int n = parameters.num_joints();
  constexpr int kSamples = 200;
  std::mt19937_64 random(1);
  const auto uniform = [&random](double size) {
    return size * (static_cast<double>(random() >> 11) * 0x1p-52 - 1);
  };
  Regressor regressor = parameters.MakeRegressor();
  const double root3 = std::sqrt(3.0);
  MatrixXd sum = MatrixXd::Zero(n, parameters.size()), U;
  VectorXd q(n), qd(n), qdd(n);
  for (int s = 0; s < kSamples; ++s) {
    for (int j = 0; j < n; ++j) {
      const double unit = parameters.rotational(j) ? 1 : 0.2;
      q[j] = uniform(3.14159 * unit);
      qd[j] = uniform(root3 * speed * unit);
      qdd[j] = uniform(root3 * speed * unit * 2 * 3.14159 * hz);
    }
    regressor.Differential(
        q, qd, qdd, VectorXd::Ones(regressor.columns().terms.size()), &U);
    sum += U.cwiseAbs2();
  }
  return (sum / kSamples).cwiseSqrt();
}

}  // namespace

ReferenceMotion MakeReferenceMotion(const ModelParameters& parameters,
                                    double speed, double hz, double unit,
                                    const VectorXd& recorded,
                                    const VectorXd& nominal) {
  ReferenceMotion reference;
  reference.columns = unit * RichColumns(parameters, speed, hz);
  reference.torque = recorded.cwiseMax(
      (reference.columns * nominal.asDiagonal()).rowwise().norm());
  // A joint that carries none and has no nominal inertia: as the others.
  const double mean = reference.torque.mean();
  for (double& x : reference.torque) {
    if (x <= 1e-12 * mean || x == 0) x = mean > 0 ? mean : 1;
  }
  return reference;
}

WeightedSystem MakeWeightedSystem(const BlockTriangularFactor& factor,
                                  const VectorXd& noise,
                                  const ReferenceMotion& reference) {
  const int m = factor.num_parameters();
  WeightedSystem system;
  system.scale = VectorXd::Zero(m);
  Eigen::Index height = 0;
  for (int i = 0; i < factor.num_joints(); ++i) {
    height += factor.columns(i).size() + 1;
    if (noise[i] <= 0) continue;
    system.scale += (reference.columns.row(i) / reference.torque[i])
                        .transpose()
                        .cwiseAbs2();
  }
  system.scale = system.scale.cwiseSqrt();
  for (double& s : system.scale) s = s > 0 ? s : 1;
  MatrixXd stacked = MatrixXd::Zero(std::max<Eigen::Index>(height, m), m + 1);
  Eigen::Index at = 0;
  for (int i = 0; i < factor.num_joints(); ++i) {
    const std::vector<int>& columns = factor.columns(i);
    const Eigen::Index k = columns.size() + 1;
    if (noise[i] > 0) {
      const MatrixXd R = factor.Triangle(i);
      for (Eigen::Index c = 0; c < k; ++c) {
        const Eigen::Index to = c + 1 < k ? columns[c] : m;
        stacked.col(to).segment(at, k) = R.col(c) / noise[i];
      }
    }
    at += k;
  }
  const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(stacked);
  system.R = stacked.topLeftCorner(m, m).triangularView<Eigen::Upper>();
  system.z = stacked.col(m).head(m);
  return system;
}

WeightedSystem::Directions WeightedSystem::Decompose() const {
  const MatrixXd scaled = R * scale.cwiseInverse().asDiagonal();
  const Eigen::BDCSVD<MatrixXd> svd(scaled,
                                    Eigen::ComputeFullU | Eigen::ComputeFullV);
  Directions d;
  d.V = svd.matrixV();
  d.s = svd.singularValues();
  d.Uz = svd.matrixU().transpose() * z;
  d.rank = Rank(d.s);
  return d;
}

Identifiability AnalyzeIdentifiability(const BlockTriangularFactor& factor,
                                       const ModelParameters& parameters,
                                       const VectorXd& noise,
                                       const ReferenceMotion& reference) {
  Identifiability result;
  for (int i = 0; i < factor.num_joints(); ++i) {
    const int begin = factor.block_begin(i), size = factor.block_size(i);
    result.block_size.push_back(size);
    VectorXd scale = reference.columns.row(i).segment(begin, size).transpose() /
                     reference.torque[i];
    for (double& s : scale) s = s > 0 ? s : 1;
    const double sigma = noise[i] > 0 ? noise[i] : reference.torque[i];
    const MatrixXd A = factor.Triangle(i).topLeftCorner(size, size) *
                       scale.cwiseInverse().asDiagonal() / sigma;
    const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeFullV);
    int rank = Rank(svd.singularValues());
    if (noise[i] <= 0) rank = 0;
    result.block_rank.push_back(rank);
    const MatrixXd unseen = EchelonBasis(svd.matrixV().rightCols(size - rank));
    for (int k = 0; k < size - rank; ++k) {
      result.block_directions.push_back(
          MakeDirection(unseen.col(k), scale, begin, i, parameters));
    }
  }
  const WeightedSystem system = MakeWeightedSystem(factor, noise, reference);
  const WeightedSystem::Directions d = system.Decompose();
  result.total = factor.num_parameters();
  result.batch_rank = d.rank;
  const MatrixXd unseen = EchelonBasis(d.V.rightCols(result.total - d.rank));
  for (int k = 0; k < result.total - d.rank; ++k) {
    result.directions.push_back(
        MakeDirection(unseen.col(k), system.scale, 0, -1, parameters));
  }
  return result;
}

}  // namespace armcal
