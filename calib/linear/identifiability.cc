#include "calib/linear/identifiability.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "calib/numerics/combination.h"
#include "calib/numerics/readable_sum.h"
#include "calib/numerics/singular_values.h"
#include "model/signals/dense_solvers.h"
#include "model/simd/kernels.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rank is decided on scaled singular values. With y = scale * x, a unit of y in
// any direction makes a torque as large as the reference's in a rich motion,
// and rows are divided by the noise; so the estimate of a singular direction of
// y has the standard deviation 1 / s. Two questions are asked. Is s > 1, that
// is, is the torque of that direction known to better than its own size? And is
// s above kExcited times the largest, or could the logs' digits and rounding
// have made it? Columns are never scaled by their own norms: a column that is
// not excited would then be as long as the rest, and its noise would pass for
// information. The answer is yes or no, so that what is not seen has no
// standard deviation rather than a large one (docs/theory.md, 2).
constexpr double kExcited = 1e-8;  // relative to the direction seen best

// Names the directions that the columns of `unseen` span. They are of the
// parameters from `begin` on.
std::vector<UnidentifiableDirection> MakeDirections(
    const MatrixXd& unseen, const VectorXd& scale, int begin, int block,
    const ModelParameters& parameters) {
  std::vector<std::string> names;
  for (Eigen::Index k = 0; k < unseen.rows(); ++k) {
    names.push_back(ReadableSum(parameters.parameters()[begin + k].name));
  }
  std::vector<UnidentifiableDirection> directions;
  for (const Combination& c : NameCombinations(unseen, scale, names)) {
    VectorXd x = VectorXd::Zero(parameters.size());
    x.segment(begin, c.x.size()) = c.x;
    directions.push_back({block, x, c.text});
  }
  return directions;
}

// The rank of a system with unit noise, in coordinates relative to the joints'
// torque. A singular value below 1 leaves more than the whole torque undecided.
int Rank(const VectorXd& s) {
  int rank = 0;
  for (const double x : s) {
    if (x > 1 && x > kExcited * s[0]) ++rank;
  }
  return rank;
}

// The rms of the columns of U over 200 random states, always the same ones: q
// over a turn, qd and qdd uniform with the rms of a motion of this speed and
// frequency (the factor sqrt(3) of a uniform distribution; an acceleration is 2
// pi hz times the speed). Some per cent of error do no harm, since ranks are
// decided over many orders.
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

// torque_i = max(recorded rms, |columns_i * nominal|): terms are added as if
// independent, root of the sum of squares.
ReferenceScale MakeReferenceScale(const ModelParameters& parameters,
                                  double speed, double hz, double unit,
                                  const VectorXd& recorded,
                                  const VectorXd& nominal) {
  ReferenceScale reference;
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

// Stacks the joints' triangles, each divided by its noise, and triangularises
// the stack: R'R = sum_i U_i'U_i / noise_i^2 without ever forming that sum,
// whose condition is the square of R's. `scale` adds up over joints what a
// parameter can do to their torques.
WeightedSystem MakeWeightedSystem(const BlockTriangularFactor& factor,
                                  const VectorXd& noise,
                                  const ReferenceScale& reference) {
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
  MatrixXd stacked = MatrixXd::Zero((height + 7) / 8 * 8, m + 1);
  Eigen::Index at = 0;
  for (int i = 0; i < factor.num_joints(); ++i) {
    const std::vector<int>& columns = factor.columns(i);
    const Eigen::Index k = columns.size() + 1;
    if (noise[i] > 0) {
      const MatrixXd& R = factor.Triangle(i);
      for (Eigen::Index c = 0; c < k; ++c) {
        const Eigen::Index to = c + 1 < k ? columns[c] : m;
        stacked.col(to).segment(at, k) = R.col(c) / noise[i];
      }
    }
    at += k;
  }
  MatrixXd R = MatrixXd::Zero(m + 1, m + 1);
  simd::BestKernels().householder(R.data(), m + 1, m + 1, stacked.data(),
                                  stacked.rows(), stacked.rows(), false);
  system.R = R.topLeftCorner(m, m);
  system.z = R.col(m).head(m);
  return system;
}

// Frobenius norms bound the singular values, s_min >= 1 / |A^-1| and s_max <=
// |A| (Golub & Van Loan, 2.3). If even the bounds pass Rank()'s thresholds, all
// directions do, and a triangular inverse replaces an SVD of some twenty times
// its cost.
std::optional<MatrixXd> WeightedSystem::Inverse() const {
  const MatrixXd scaled = R * scale.cwiseInverse().asDiagonal();
  const MatrixXd inverse = scaled.triangularView<Eigen::Upper>().solve(
      MatrixXd::Identity(R.rows(), R.cols()));
  // Bounds of the least and the greatest singular value.
  const double least = 1 / inverse.norm();
  if (!(least > 1 && least > kExcited * scaled.norm())) return {};
  return inverse;
}

WeightedSystem::Directions WeightedSystem::Decompose() const {
  const MatrixXd scaled = R * scale.cwiseInverse().asDiagonal();
  const SingularValues svd = DecomposeSingular(scaled);
  Directions d;
  d.V = svd.V;
  d.s = svd.s;
  d.Uz = svd.U.transpose() * z;
  d.rank = Rank(d.s);
  return d;
}

// The rank condition (2.30) of each diagonal block U_ii by itself, from the
// corner of joint i's triangle, and then of the whole. Blocks may fail where
// the whole does not: a parameter of block i may show in the torque of joints
// before it alone. The right singular vectors beyond the rank span what cannot
// be seen.
Identifiability AnalyzeIdentifiability(const BlockTriangularFactor& factor,
                                       const ModelParameters& parameters,
                                       const VectorXd& noise,
                                       const ReferenceScale& reference) {
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
    for (const UnidentifiableDirection& direction :
         MakeDirections(svd.matrixV().rightCols(size - rank), scale, begin, i,
                        parameters)) {
      result.block_directions.push_back(direction);
    }
  }
  const WeightedSystem system = MakeWeightedSystem(factor, noise, reference);
  const WeightedSystem::Directions d = system.Decompose();
  result.total = factor.num_parameters();
  result.batch_rank = d.rank;
  result.directions = MakeDirections(d.V.rightCols(result.total - d.rank),
                                     system.scale, 0, -1, parameters);
  return result;
}

}  // namespace armcal
