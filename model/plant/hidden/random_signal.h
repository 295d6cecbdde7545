#pragma once

#include <random>
#include <vector>

namespace armcal {

// The same number on every platform for the same state.
double DrawUniform(double low, double high, std::mt19937_64* random);
double DrawLogUniform(double low, double high, std::mt19937_64* random);

// A smooth function of time that looks random: sines of random phase, equally
// spaced in log frequency, of rms 1 over long times. With equal amplitudes it
// wanders as noise of density 1/f does.
class RandomSignal {
 public:
  RandomSignal(double low_hz, double high_hz, std::mt19937_64* random);
  double operator()(double t) const;

 private:
  struct Sine {
    double omega, phase;  // rad/s, rad
  };
  std::vector<Sine> sines_;
};

// A smooth function between 0 and 1: some spans of time at random in
// [0, duration], s, with flanks of 50 ms.
class RandomSpans {
 public:
  RandomSpans(int count, double length, double duration,
              std::mt19937_64* random);
  double operator()(double t) const;

 private:
  double length_;
  std::vector<double> begins_;
};

}  // namespace armcal
