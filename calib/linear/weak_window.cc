#include "calib/linear/weak_window.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

// A test function of w seconds passes what changes slower than about 1.5 / w
// Hz: its spectrum is down to a third there, and to a tenth at 2 / w.
constexpr double kPeriods = 1.5;
// Trapezoids over a test function have order 4: an error of 1e-6 of the torque
// with 50 samples (weak_rows.h) is 1e-4 with 16.
constexpr double kLeastPerWindow = 16;
// With it accelerations of encoders with 1e-4 rad at 500 Hz bias a SCARA's
// inertia by less than .02 % (its calibration_long_test.cc); noise asks for no
// longer ones, which would not see friction change sign.
constexpr double kLongest = 0.3;
// Noise in a regressor's column shrinks its coefficient by the noise's share of
// what the other columns leave of the column (attenuation; Fuller, Measurement
// Error Models, 1987, 1.1). A column of which they leave 1 % shrinks by 1 %,
// half of what torque constants are known to (2 %). The length goes as this
// share to the power -1/5: ten times as much shortens it by a third.
constexpr double kNoiseShare = 1e-4;
// Of phi(t) = 2 f(s) / (w W), s = 2 t / w - 1, f = (1 - s^2)^4, W = int f ds =
// 256/315: int phi''^2 dt = K / w^5 with K = 32 int f''^2 ds / W^2. As
// f'' = -8 (1 - s^2)^2 (1 - 7 s^2), int f''^2 ds = 64 W (1 - 14/11 + 147/143).
constexpr double kCurvature = 32. * 64 * (108. / 143) / (256. / 315);

}  // namespace

// A row's acceleration is int phi'' q dt; of white noise of density S in q it
// has the variance S K / w^5.
double NoiseWindow(const EncoderNoise& noise) {
  double longest = 0;
  for (Eigen::Index j = 0; j < noise.density.size(); ++j) {
    if (noise.travel[j] < kLeastTravel) continue;
    const double made = kCurvature * noise.density[j];
    const double allowed = kNoiseShare * noise.mean_square_acceleration[j];
    if (made <= 0) continue;
    if (allowed <= 0) return kLongest;
    longest = std::max(longest, std::pow(made / allowed, .2));
  }
  return std::min(longest, kLongest);
}

double DefaultWindow(double bandwidth_hz, const LogSet& logs) {
  double window = kPeriods / bandwidth_hz;
  for (const TimeBase& base : logs.time_bases()) {
    window = std::max(window, kLeastPerWindow * base.dt);
  }
  // Noise asks for none that is longer: spare the look at it.
  if (window >= kLongest) return window;
  return std::max(window, NoiseWindow(MeasureEncoderNoise(logs, bandwidth_hz)));
}

}  // namespace armcal
