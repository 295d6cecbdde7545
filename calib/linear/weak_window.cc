#include "calib/linear/weak_window.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

// Periods of a frequency in a test function that halves its power: the gain of
// phi(s) = (1 - s^2)^4 (PowerGain) is sqrt(1/2) there.
constexpr double kPeriodsOfHalfPower = .867;
// Trapezoids over a test function have order 4: an error of 1e-6 of the torque
// with 50 samples (weak_rows.h) is 1e-4 with 16.
constexpr double kLeastPerWindow = 16;
// Noise asks for no longer ones, which would not see friction change sign.
constexpr double kLongest = 0.3;
// Noise in a regressor's column shrinks its coefficient by the noise's share of
// what the other columns leave of the column (attenuation; Fuller, Measurement
// Error Models, 1987, 1.1). Of a column that is as collinear as regressions are
// usually let be (a variance inflation factor of 10: others leave a tenth;
// Marquardt 1970, Technometrics 12) this share shrinks the coefficient by
// 0.2 %, a tenth of what torque constants are known to (2 %).
constexpr double kNoiseShare = 2e-4;

// |int phi(t) exp(-2 pi i f t) dt|^2 of a test function of length w, with
// int phi dt = 1, at f w = cycles. By Poisson's integral (Watson, Bessel
// Functions, 1922, 3.3) the transform of (1 - s^2)^4 is
// Gamma(11/2) (2 / z)^(9/2) J_9/2(z), z = pi f w.
double PowerGain(double cycles) {
  const double z = M_PI * cycles;
  if (z < 1e-3) return 1;
  const double gain =
      std::tgamma(5.5) * std::pow(2 / z, 4.5) * std::cyl_bessel_j(4.5, z);
  return gain * gain;
}

// Variance of a row's acceleration, int phi'' q dt, per power spectral density
// of white noise in q and per bandwidth^5: q passes the low pass, of gain
// 1 / (1 + x^8) at x = f / bandwidth (low_pass.h), and the test function, of
// length `periods` of the bandwidth:
//   2 (2 pi)^4 int x^4 PowerGain(x periods) / (1 + x^8)^2 dx,
// by Simpson's rule; beyond x = 4 the integrand is below 1e-7.
double AccelerationPower(double periods) {
  constexpr int kSteps = 800;
  constexpr double kMost = 4;
  double sum = 0;
  for (int k = 1; k < kSteps; ++k) {
    const double x = kMost * k / kSteps;
    const double low_pass = 1 / (1 + std::pow(x, 8));
    sum += (k % 2 == 1 ? 4 : 2) * std::pow(x, 4) * PowerGain(x * periods) *
           low_pass * low_pass;
  }
  return 2 * std::pow(2 * M_PI, 4) * sum * kMost / kSteps / 3;
}

}  // namespace

// Solves S AccelerationPower(T bandwidth) bandwidth^5 <= kNoiseShare qdd_rms^2
// for the least T by bisection (docs/theory.md, 2), S being the encoder's power
// spectral density, of the joint with the largest S / qdd_rms^2.
double NoiseWindow(const EncoderNoise& noise, double bandwidth_hz) {
  double worst = 0;  // noise over motion, s^5
  for (Eigen::Index j = 0; j < noise.density.size(); ++j) {
    if (noise.travel[j] < kLeastTravel || noise.density[j] <= 0) continue;
    // A joint without a motor: the columns of its equation add up to nothing,
    // so that others leave of each no more than the noise.
    if (noise.torque.size() > 0 && noise.torque[j] == 0) return kLongest;
    if (noise.mean_square_acceleration[j] <= 0) return kLongest;
    worst =
        std::max(worst, noise.density[j] / noise.mean_square_acceleration[j]);
  }
  const double scale = worst * std::pow(bandwidth_hz, 5);
  const auto is_enough = [&](double window) {
    return scale * AccelerationPower(window * bandwidth_hz) <= kNoiseShare;
  };
  if (is_enough(0)) return 0;
  if (!is_enough(kLongest)) return kLongest;
  // Longer windows pass less of it.
  double low = 0, high = kLongest;
  while (high - low > 1e-4 * high) {
    const double middle = (low + high) / 2;
    (is_enough(middle) ? high : low) = middle;
  }
  return high;
}

double DefaultWindow(double bandwidth_hz, const LogSet& logs) {
  double window = kPeriodsOfHalfPower / bandwidth_hz;
  for (const TimeBase& base : logs.time_bases()) {
    window = std::max(window, kLeastPerWindow * base.dt);
  }
  // Noise asks for none that is longer: spare the look at it.
  if (window >= kLongest) return window;
  return std::max(window, NoiseWindow(MeasureEncoderNoise(logs, bandwidth_hz),
                                      bandwidth_hz));
}

}  // namespace armcal
