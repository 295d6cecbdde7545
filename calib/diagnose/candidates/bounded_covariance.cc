#include "calib/diagnose/candidates/bounded_covariance.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// E (y - z)^2 of a standard normal y above z >= 0: 1 at 0, 2 / z^2 far out.
double SquareBeyond(double z) {
  constexpr double kFar = 10;  // the asymptote's next term is 6 % of it
  if (z > kFar) return 2 / (z * z);
  const double tail = .5 * std::erfc(z / std::sqrt(2));
  const double density = std::exp(-z * z / 2) / std::sqrt(2 * M_PI);
  return std::max(0., 1 - z * density / tail + z * z);
}

// What is known of the others where parameter k is at its bound. Its posterior
// is a normal distribution cut there, whose peak lies z deviations beyond: of
// its variance SquareBeyond(z) is left as mean square about the bound, and of
// the others' what they have by themselves and their share of that. A bound
// that the data press against hard tells as much as a known value, one that
// they hardly touch nothing. Its own variance is none: the bound is what is
// told of it.
void ConditionOnBound(int k, double z, MatrixXd* covariance) {
  const VectorXd column = covariance->col(k);
  if (!(column[k] > 0)) return;
  *covariance -=
      (1 - SquareBeyond(z)) / column[k] * column * column.transpose();
  covariance->row(k).setZero();
  covariance->col(k).setZero();
}

}  // namespace

// Where the minimum is cut off by the bound of k alone, the one without bounds
// is a Newton step away whose k-th part is -C_kk g_k, C the covariance and g
// the gradient: z = |g_k| C_kk^(1/2). Several bounds are conditioned on one
// after the other.
MatrixXd BoundedCovariance(MatrixXd covariance, const VectorXd& gradient,
                           const std::vector<Coordinate>& coordinates,
                           const VectorXd& u) {
  const int size = static_cast<int>(u.size());
  for (int k = 0; k < size; ++k) {
    if (!coordinates[k].AtBound(u[k])) continue;
    const bool held = coordinates[k].IsHeld(u[k], gradient[k]);
    ConditionOnBound(
        k, held ? std::abs(gradient[k]) * std::sqrt(covariance(k, k)) : 0,
        &covariance);
  }
  VectorXd units(size);
  for (int k = 0; k < size; ++k) units[k] = coordinates[k].Slope(u[k]);
  return units.asDiagonal() * covariance * units.asDiagonal();
}

}  // namespace armcal
