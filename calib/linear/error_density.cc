#include "calib/linear/error_density.h"

#include <cmath>

namespace armcal {
namespace {

using Eigen::VectorXd;

// int phi^2 ds / (int phi ds)^2 over [-1, 1] of the weak form's test function
// phi = (1 - s^2)^4, by Wallis' integrals of (1 - s^2)^n, 2 (2 4 .. 2 n) / (3 5
// .. 2 n + 1).
double SquareOverMean() {
  const auto wallis = [](int n) {
    double value = 2;
    for (int k = 1; k <= n; ++k) value *= 2. * k / (2 * k + 1);
    return value;
  };
  return wallis(8) / (wallis(4) * wallis(4));
}

}  // namespace

// A row is int phi tau dt with int phi dt = 1 over a window of length T. White
// noise of density S gives it the variance
//   S int phi^2 dt = S SquareOverMean() 2 / T,
// which is solved for S.
VectorXd ErrorDensity(const LinearCalibration& linear) {
  if (linear.rows.identification != Identification::kWeak) {
    return VectorXd::Constant(linear.noise.size(), std::nan(""));
  }
  return linear.noise.cwiseAbs2() *
         (linear.rows.window_s / (2 * SquareOverMean()));
}

}  // namespace armcal
