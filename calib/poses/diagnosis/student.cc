#include "calib/poses/diagnosis/student.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

// m: rounding of a metre; data without noise have some scale.
constexpr double kLeastScale = 1e-15;
constexpr int kScaleRounds = 200;
constexpr double kScaleAtRest = 1e-9;  // relative

Eigen::VectorXd SquaresByPose(const Eigen::VectorXd& r, int width) {
  return r.reshaped(width, r.size() / width).colwise().squaredNorm();
}

// Of -2 log p, what does not depend on residuals or scale, a pose.
double Constant(double nu, double d) {
  if (std::isinf(nu)) return d * std::log(2 * M_PI);
  return 2 * (std::lgamma(nu / 2) - std::lgamma((nu + d) / 2)) +
         d * std::log(nu * M_PI);
}

}  // namespace

// The scale is a fixed point of s^2 = mean_k w_k |r_k|^2 / d, which EM climbs
// to (Lange, Little and Taylor 1989).
StudentFit FitStudent(const Eigen::VectorXd& r, int width, double nu) {
  const Eigen::ArrayXd squares = SquaresByPose(r, width).array();
  const double d = width, poses = static_cast<double>(squares.size());
  StudentFit fit;
  double s2 = std::max(squares.sum() / (poses * d), kLeastScale * kLeastScale);
  fit.weights = Eigen::VectorXd::Ones(squares.size());
  for (int round = 0; !std::isinf(nu) && round < kScaleRounds; ++round) {
    fit.weights = (nu + d) / (nu + squares / s2);
    const double next = std::max(
        (fit.weights.array() * squares).sum() / (fit.weights.sum() * d),
        kLeastScale * kLeastScale);
    const bool at_rest = std::abs(next - s2) < kScaleAtRest * s2;
    s2 = next;
    if (at_rest) break;
  }
  fit.scale = std::sqrt(s2);
  const double spread = std::isinf(nu)
                            ? squares.sum() / s2
                            : (nu + d) * (1 + squares / (nu * s2)).log().sum();
  fit.deviance = spread + poses * (d * std::log(s2) + Constant(nu, d));
  return fit;
}

double StudentVarianceFactor(const Eigen::VectorXd& r, int width, double nu,
                             const StudentFit& fit, double unknowns) {
  const Eigen::ArrayXd s =
      SquaresByPose(r, width).array() / (fit.scale * fit.scale);
  const double d = width, N = static_cast<double>(r.size());
  const Eigen::ArrayXd w = fit.weights.array();
  // psi = w x; the mean of its derivative over d coordinates is w + 2 w' s / d.
  double squares = (w * w * s).sum(), slope = d * w.sum();
  if (!std::isinf(nu)) slope -= (2 * w * s / (nu + s)).sum();
  const double mean_weight = w.mean();
  slope /= N;
  // (J'J)^-1 of equal weights times Huber's factor; J'WJ has the mean weight.
  return squares / std::max(1.0, N - unknowns) / (slope * slope) * mean_weight;
}

}  // namespace armcal
