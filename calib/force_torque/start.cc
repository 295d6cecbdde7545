#include "calib/force_torque/start.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "calib/numerics/block_bootstrap.h"
#include "calib/numerics/median.h"
#include "problems/robust_loss.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using Weights = std::vector<double>;

// Weighted means, and sums of products about them.
struct ForceMoments {
  double weight = 0;
  Vector3d u = Vector3d::Zero(), f = Vector3d::Zero();
  Matrix3d uu = Matrix3d::Zero(), fu = Matrix3d::Zero();
};

ForceMoments MomentsOf(const std::vector<ForceTorqueSample>& samples,
                       const Weights& weights) {
  ForceMoments sums;
  for (size_t k = 0; k < samples.size(); ++k) {
    sums.weight += weights[k];
    sums.u += weights[k] * samples[k].motion.acceleration;
    sums.f += weights[k] * samples[k].wrench.head<3>();
  }
  sums.u /= sums.weight;
  sums.f /= sums.weight;
  for (size_t k = 0; k < samples.size(); ++k) {
    const Vector3d u = samples[k].motion.acceleration - sums.u;
    sums.uu += weights[k] * u * u.transpose();
    sums.fu +=
        weights[k] * (samples[k].wrench.head<3>() - sums.f) * u.transpose();
  }
  return sums;
}

// Least squares in all directions in which u changes beyond rounding.
struct ForceSolution {
  ForceMoments sums;
  Vector3d spread;      // eigenvalues of the covariance of u, times the weight
  Matrix3d directions;  // its eigenvectors
  double least;         // spread that is no more than rounding
  Matrix3d M = Matrix3d::Zero();
};

ForceSolution SolveForces(const std::vector<ForceTorqueSample>& samples,
                          const Weights& weights) {
  constexpr double kRounding = 1e-9;  // of the acceleration's square
  ForceSolution solution;
  const ForceMoments& sums = solution.sums = MomentsOf(samples, weights);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(sums.uu);
  solution.spread = eigen.eigenvalues();
  solution.directions = eigen.eigenvectors();
  solution.least = kRounding * sums.weight * sums.u.squaredNorm();
  for (int i = 0; i < 3; ++i) {
    const Vector3d v = solution.directions.col(i);
    if (solution.spread[i] > solution.least) {
      solution.M += sums.fu * v / solution.spread[i] * v.transpose();
    }
  }
  return solution;
}

// What it leaves of each sample's force, N.
std::vector<Vector3d> LeftOfForces(
    const ForceSolution& solution,
    const std::vector<ForceTorqueSample>& samples) {
  std::vector<Vector3d> left;
  left.reserve(samples.size());
  for (const ForceTorqueSample& s : samples) {
    left.emplace_back(s.wrench.head<3>() - solution.sums.f -
                      solution.M * (s.motion.acceleration - solution.sums.u));
  }
  return left;
}

// Of Huber's loss of the force's length, whose median is 1.538 deviations.
Weights WeighForces(const std::vector<Vector3d>& left) {
  std::vector<double> lengths;
  for (const Vector3d& r : left) lengths.push_back(r.norm());
  const double bend =
      LossScale(RobustLoss::kHuber, 3) * Median(lengths) / 1.538;
  Weights weights;
  for (const double length : lengths) {
    weights.push_back(length > bend ? bend / length : 1);
  }
  return weights;
}

// Variance of a weighted force of which M leaves the rest, times the
// autocorrelation time: of white noise that would tell as little. Of the worst
// of the three.
double NoiseOfForces(const std::vector<Vector3d>& left,
                     const Weights& weights) {
  double worst = 0;
  std::vector<double> weighted(left.size());
  for (int c = 0; c < 3; ++c) {
    double square = 0;
    for (size_t k = 0; k < left.size(); ++k) {
      weighted[k] = weights[k] * left[k][c];
      square += weighted[k] * weighted[k];
    }
    const double variance = square / static_cast<double>(left.size());
    worst = std::max(worst, variance * CorrelationTime(weighted));
  }
  return worst;
}

}  // namespace

ForceTorqueStart StartForceTorque(
    const std::vector<ForceTorqueSample>& samples) {
  constexpr double kTold = 10;  // standard deviations
  constexpr size_t kFewest = 20;
  constexpr int kPasses = 20;
  ForceTorqueStart start;
  if (samples.size() < kFewest) return start;
  Weights weights(samples.size(), 1);
  ForceSolution solution = SolveForces(samples, weights);
  for (int pass = 0; pass < kPasses; ++pass) {
    weights = WeighForces(LeftOfForces(solution, samples));
    solution = SolveForces(samples, weights);
  }
  const double noise = NoiseOfForces(LeftOfForces(solution, samples), weights);
  for (int i = 0; i < 3; ++i) {
    const double spread = solution.spread[i];
    const Vector3d v = solution.directions.col(i), column = solution.M * v;
    if (spread <= solution.least ||
        column.norm() < kTold * std::sqrt(3 * noise / spread)) {
      continue;
    }
    ++start.directions;
    start.M += column * v.transpose();
  }
  if (start.directions > 0) {
    start.mass = Eigen::JacobiSVD<Matrix3d>(start.M).singularValues().sum() /
                 start.directions;
  }
  return start;
}

}  // namespace armcal
