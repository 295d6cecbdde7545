#include "calib/linear/error_density.h"

#include <cmath>

namespace armcal {
namespace {

using Eigen::VectorXd;

// Of the weak form's test function (1 - s^2)^4: int phi^2 ds / (int phi ds)^2
// over [-1, 1], by Wallis' integrals 2 (2 4 .. 2 n) / (3 5 .. 2 n + 1).
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
// noise of density S makes a variance S int phi^2 dt = S SquareOverMean() 2 / T
// of it; solved for S.
VectorXd ErrorDensity(const LinearCalibration& linear) {
  if (linear.rows.identification != Identification::kWeak) {
    return VectorXd::Constant(linear.noise.size(), std::nan(""));
  }
  return linear.noise.cwiseAbs2() *
         (linear.rows.window_s / (2 * SquareOverMean()));
}

}  // namespace armcal
