#include "calib/linear/solution.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "calib/numerics/posterior.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd LinearSolution::CovarianceFromScores(const MatrixXd& scores) const {
  return Sandwich(gain, scores);
}

MatrixXd LinearSolution::IndependentCovariance(
    const BlockTriangularFactor& factor, const VectorXd& noise) const {
  const int m = factor.num_parameters();
  MatrixXd scores = MatrixXd::Zero(m, m);
  for (int i = 0; i < factor.num_joints(); ++i) {
    const std::vector<int>& columns = factor.columns(i);
    const Eigen::Index k =
        own_block_only ? factor.block_size(i) : columns.size();
    const MatrixXd R = factor.Triangle(i).leftCols(k);
    const MatrixXd S = R.transpose() * R;
    const double scale = std::pow(weight[i] * noise[i], 2);
    for (Eigen::Index a = 0; a < k; ++a) {
      for (Eigen::Index b = 0; b < k; ++b) {
        scores(columns[a], columns[b]) += scale * S(a, b);
      }
    }
  }
  return CovarianceFromScores(scores);
}

namespace {

// gain * weight_i U_i' y_i of each joint, U_i restricted to its own block for
// the recursion.
MatrixXd ByScale(const BlockTriangularFactor& factor,
                 const LinearSolution& solution) {
  MatrixXd scores =
      MatrixXd::Zero(factor.num_parameters(), factor.num_joints());
  for (int i = 0; i < factor.num_joints(); ++i) {
    const std::vector<int>& columns = factor.columns(i);
    const MatrixXd& R = factor.Triangle(i);
    const Eigen::Index k =
        solution.own_block_only ? factor.block_size(i) : columns.size();
    const VectorXd score =
        R.leftCols(k).transpose() * R.col(static_cast<int>(columns.size()));
    for (Eigen::Index c = 0; c < k; ++c) {
      scores(columns[c], i) = solution.weight[i] * score[c];
    }
  }
  return solution.gain * scores;
}

}  // namespace

LinearSolution SolveWeighted(const BlockTriangularFactor& factor,
                             const VectorXd& noise,
                             const ReferenceScale& reference) {
  const int m = factor.num_parameters();
  const WeightedSystem system = MakeWeightedSystem(factor, noise, reference);
  LinearSolution solution;
  solution.solved = true;
  solution.weighted = true;
  VectorXd y, share = VectorXd::Zero(m);
  MatrixXd inverse;
  if (const auto R_inverse = system.Inverse()) {
    y = *R_inverse * system.z;
    inverse = *R_inverse * R_inverse->transpose();
  } else {
    const WeightedSystem::Directions d = system.Decompose();
    const auto seen = d.V.leftCols(d.rank);
    const VectorXd s = d.s.head(d.rank);
    y = seen * d.Uz.head(d.rank).cwiseQuotient(s);
    const MatrixXd scaled = seen * s.cwiseInverse().asDiagonal();
    inverse = scaled * scaled.transpose();
    share = d.V.rightCols(m - d.rank).rowwise().squaredNorm();
  }
  const auto unscale = system.scale.cwiseInverse();
  solution.x = unscale.cwiseProduct(y);
  solution.gain = unscale.asDiagonal() * inverse * unscale.asDiagonal();
  solution.weight.setZero(noise.size());
  for (int i = 0; i < noise.size(); ++i) {
    if (noise[i] > 0) solution.weight[i] = 1 / (noise[i] * noise[i]);
  }
  for (int c = 0; c < m; ++c) solution.identifiable.push_back(share[c] < 1e-6);
  solution.by_scale = ByScale(factor, solution);
  return solution;
}

LinearSolution SolveBatch(const BlockTriangularFactor& factor,
                          const ReferenceScale& reference) {
  // Equal noise: its size decides only what counts as unseen.
  const double noise = std::max(1e-300, 1e-9 * RightSideRms(factor).maxCoeff());
  LinearSolution solution = SolveWeighted(
      factor, VectorXd::Constant(factor.num_joints(), noise), reference);
  solution.gain /= noise * noise;  // by_scale has the weights, too
  solution.weight.setOnes();
  solution.weighted = false;
  return solution;
}

LinearSolution SolveRecursive(const BlockTriangularFactor& factor,
                              const Identifiability& identifiability) {
  const int m = factor.num_parameters();
  LinearSolution solution;
  solution.own_block_only = true;
  solution.x = VectorXd::Zero(m);
  solution.gain = MatrixXd::Zero(m, m);
  solution.weight.setOnes(factor.num_joints());
  solution.identifiable.assign(m, true);
  for (int i = 0; i < factor.num_joints(); ++i) {
    const int rank = identifiability.block_rank[i];
    if (rank == factor.block_size(i)) continue;
    solution.refusal += (solution.refusal.empty() ? "" : "; ") +
                        std::string("block ") + std::to_string(i + 1) +
                        " has rank " + std::to_string(rank) + " of " +
                        std::to_string(factor.block_size(i));
  }
  if (!solution.refusal.empty()) return solution;
  for (int i = factor.num_joints() - 1; i >= 0; --i) {
    const int begin = factor.block_begin(i), size = factor.block_size(i);
    if (size == 0) continue;
    const MatrixXd& R = factor.Triangle(i);
    const std::vector<int>& columns = factor.columns(i);
    const auto R_ii =
        R.topLeftCorner(size, size).triangularView<Eigen::Upper>();
    VectorXd z = R.col(columns.size()).head(size);
    // d x_i = (U_ii' U_ii)^-1 (score_i - U_ii' sum_j U_ij d x_j)
    MatrixXd g = MatrixXd::Zero(size, m);
    for (size_t c = size; c < columns.size(); ++c) {
      z -= R.col(c).head(size) * solution.x[columns[c]];
      g -= R.col(c).head(size) * solution.gain.row(columns[c]);
    }
    g.middleCols(begin, size) +=
        R_ii.transpose().solve(MatrixXd::Identity(size, size));
    solution.x.segment(begin, size) = R_ii.solve(z);
    solution.gain.middleRows(begin, size) = R_ii.solve(g);
  }
  solution.by_scale = ByScale(factor, solution);
  solution.solved = true;
  return solution;
}

VectorXd EstimateNoise(const BlockTriangularFactor& factor, const VectorXd& x) {
  const int n = factor.num_joints();
  double rows = 0;
  for (int i = 0; i < n; ++i) rows += static_cast<double>(factor.rows(i));
  const double spent = factor.num_parameters();
  const double correction = rows > spent ? std::sqrt(rows / (rows - spent)) : 1;
  const VectorXd torque = RightSideRms(factor);
  VectorXd noise(n);
  for (int i = 0; i < n; ++i) {
    const double count = static_cast<double>(std::max(1L, factor.rows(i)));
    const double rms = factor.ResidualNorm(i, x) / std::sqrt(count);
    noise[i] = std::max({correction * rms, 1e-9 * torque[i],
                         1e-12 * torque.maxCoeff(), 1e-300});
  }
  return noise;
}

LinearSolution SolveReweighted(const BlockTriangularFactor& factor,
                               const ReferenceScale& reference,
                               const std::vector<bool>& excluded,
                               VectorXd* noise) {
  LinearSolution solution;
  for (int iteration = 0; iteration < 20; ++iteration) {
    // The first noise is a guess, as large as the torque: directions must not
    // be dropped for it, or what they explain would be taken for noise ever
    // after.
    solution = SolveWeighted(
        factor, iteration == 0 ? VectorXd(1e-6 * *noise) : *noise, reference);
    const VectorXd estimate = EstimateNoise(factor, solution.x);
    double change = 0;
    for (int i = 0; i < noise->size(); ++i) {
      if (excluded[i]) continue;
      change = std::max(change, std::abs(std::log(estimate[i] / (*noise)[i])));
      (*noise)[i] = estimate[i];
    }
    if (iteration > 0 && change < 0.02) break;
  }
  return solution;
}

}  // namespace armcal
