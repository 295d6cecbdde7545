#include "model/robot_files/inertia_split.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>

namespace armcal {
namespace {

using Eigen::Matrix4d;

// Of the way to where the head could not exist; the head keeps the rest, a
// tenth of `total` in every direction.
constexpr double kWayToBoundary = 0.9;

InertialParameters Less(const InertialParameters& total, double share,
                        const InertialParameters& part) {
  return InertialParameters::FromVector(total.ToVector() -
                                        share * part.ToVector());
}

// The largest eigenvalue of P(total)^-1 P(part), by the symmetric C^-1 P(part)
// C^-T with C C' = P(total). Nothing where P(total) has no such factor: `total`
// is not inside what can exist.
std::optional<double> LargestRatio(const InertialParameters& total,
                                   const InertialParameters& part) {
  const Eigen::LLT<Matrix4d> factor(PseudoInertia(total.ToVector()));
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Matrix4d half =
      factor.matrixL().solve(PseudoInertia(part.ToVector())).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix4d> ratios(
      Matrix4d(factor.matrixL().solve(half)), Eigen::EigenvaluesOnly);
  const double largest = ratios.eigenvalues().maxCoeff();
  if (!(largest > 0)) return std::nullopt;  // nor if numbers overflow
  return largest;
}

}  // namespace

InertiaSplit SplitInertia(const InertialParameters& total,
                          const InertialParameters& fixed,
                          const InertialParameters& held) {
  const InertialParameters own = Less(total, 1, held);
  InertiaSplit split{Less(own, 1, fixed), true, 1};
  if (WhyUnphysical(split.head).empty()) return split;
  split = {own, false, 1};
  if (WhyUnphysical(own).empty()) return split;
  const std::optional<double> ratio = LargestRatio(total, held);
  if (ratio) {
    split.held_share = std::min(1., kWayToBoundary / *ratio);
  } else if (held.mass > 0) {  // a head without mass has no centre of mass
    split.held_share = std::min(1., total.mass / held.mass / 2);
  }
  split.head = Less(total, split.held_share, held);
  return split;
}

}  // namespace armcal
