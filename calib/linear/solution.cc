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

// The covariance G S G' of x = G sum_i w_i U_i' y_i, with S = sum_i (w_i
// noise_i)^2 U_i' U_i: errors of variance noise_i^2 that know nothing of each
// other. For the weighted solution w_i = 1 / noise_i^2 makes S the inverse of
// G, and (U' W U)^-1 is left; the paper's solvers have other weights and keep
// the whole sandwich. U_i' U_i = R' R comes from the factor.
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

// Column i is G w_i U_i' y_i, joint i's part in x. The estimate is linear in
// the right sides, so that torques of joint i that are all 1 + e_i times as
// large change x by e_i times this column (docs/theory.md, 2). For the
// recursion U_i is restricted to its own block.
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

// Weighted least squares, min sum_i |U_i x - y_i|^2 / noise_i^2, from the
// joints' triangular factors (QR; Golub & Van Loan, Matrix Computations, 5.3).
// Where all directions count beyond doubt, the inverse of the triangle is
// enough. Else the singular directions that count are solved, x = V s^-1 U'z,
// and the others are left at 0: the truncated SVD (Bjorck 1996, 2.7), without
// which the noise in a direction that hardly shows would swamp every parameter
// in it. A parameter is identifiable where the unseen directions V_0 hold none
// of it, (V_0 V_0')_cc < 1e-6.
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

// The paper's (2.28), from the last joint to the first: with the blocks beyond
// joint i known,
//   x_i = (U_ii' U_ii)^-1 U_ii' (y_i - sum_{j > i} U_ij x_j).
// Each step is a triangular solve with R_ii, the corner of joint i's factor.
// The gain goes through the same recursion, column by column, so that the
// errors that later blocks hand up are in the covariance.
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

// The noise of joint i is the rms of its residuals, times sqrt(N / (N - m)) of
// all joints' N equations for the m parameters that were fitted to them. The
// floors keep a joint that is fitted exactly (simulated logs without noise)
// from getting all of the weight.
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

// Feasible generalised least squares: the weights need the noise, the noise
// needs the residuals. Alternating between both maximises the likelihood of
// normal errors whose variances, one per joint, are unknown. A round costs a
// small QR, as only the factors are needed and no log.
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
