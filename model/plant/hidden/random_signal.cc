#include "model/plant/hidden/random_signal.h"

#include <cmath>

#include "model/text/uniform_draw.h"

namespace armcal {

namespace {

constexpr int kSines = 16;
constexpr double kFlank = .05;  // s

}  // namespace

double DrawUniform(double low, double high, std::mt19937_64* random) {
  const double u = UniformDraw(random);
  return low + (high - low) * u;
}

double DrawLogUniform(double low, double high, std::mt19937_64* random) {
  return std::exp(DrawUniform(std::log(low), std::log(high), random));
}

RandomSignal::RandomSignal(double low_hz, double high_hz,
                           std::mt19937_64* random) {
  const double ratio = std::log(high_hz / low_hz);
  for (int k = 0; k < kSines; ++k) {
    // Jittered, so that the signal has no period.
    const double share = (k + DrawUniform(0, 1, random)) / kSines;
    sines_.push_back({2 * M_PI * low_hz * std::exp(share * ratio),
                      DrawUniform(0, 2 * M_PI, random)});
  }
}

double RandomSignal::operator()(double t) const {
  double sum = 0;
  for (const Sine& sine : sines_) sum += std::sin(sine.omega * t + sine.phase);
  return std::sqrt(2. / kSines) * sum;
}

RandomSpans::RandomSpans(int count, double length, double duration,
                         std::mt19937_64* random)
    : length_(length) {
  // One span in each equal part, so that none overlap.
  for (int k = 0; k < count; ++k) {
    begins_.push_back((k + DrawUniform(0, .5, random)) * duration / count);
  }
}

double RandomSpans::operator()(double t) const {
  double sum = 0;
  for (const double begin : begins_) {
    sum += (std::tanh((t - begin) / kFlank) -
            std::tanh((t - begin - length_) / kFlank)) /
           2;
  }
  return sum;
}

}  // namespace armcal
