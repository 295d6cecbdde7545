#include "calib/refine/possible_range.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>

namespace armcal {

using Eigen::Matrix4d;

void PossibleRange::KeepPositive(double at, double along) {
  if (along < 0) range_.most = std::min(range_.most, at / -along);
  if (along > 0) range_.least = std::max(range_.least, -at / along);
}

// The pseudo-inertia on the line is C (1 + t D) C' with C C' the one at `at`
// and D = C^-1 P(along) C^-T, positive as long as 1 + t lambda > 0 for all
// eigenvalues lambda of D (docs/theory.md, 3).
void PossibleRange::KeepPossible(const Vector10d& at, const Vector10d& along) {
  if (along.isZero(0)) return;
  const Eigen::LLT<Matrix4d> factor(PseudoInertia(at));
  const Matrix4d half =
      factor.matrixL().solve(PseudoInertia(along)).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix4d> relative(
      Matrix4d(factor.matrixL().solve(half)), Eigen::EigenvaluesOnly);
  for (const double lambda : relative.eigenvalues()) KeepPositive(1, lambda);
}

LineRange PossibleRange::range() const {
  constexpr double kInside = 1 - 1e-9;
  return {kInside * range_.least, kInside * range_.most};
}

}  // namespace armcal
