#include "calib/diagnose/candidates/search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "model/simd/kernels.h"

namespace armcal {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Peak {
  double at;
  double power;
};

std::vector<Peak> Sorted(std::vector<Peak> peaks) {
  std::sort(peaks.begin(), peaks.end(),
            [](const Peak& a, const Peak& b) { return a.power > b.power; });
  return peaks;
}

// A cosine and a sine at each of some angles.
struct Waves {
  explicit Waves(const ArrayXd& angle)
      : cosine(angle.size()), sine(angle.size()) {
    simd::BestKernels().sine_cosine(angle.data(), angle.size(), sine.data(),
                                    cosine.data());
  }
  ArrayXd cosine, sine;
};

double Power(const VectorXd& residual, const VectorXd& place, double w) {
  const Waves waves(w * place.array());
  return std::norm(std::complex<double>((residual.array() * waves.cosine).sum(),
                                        (residual.array() * waves.sine).sum()));
}

// Power() at w[0], w[0] + step, w[0] + 2 step ..: waves are turned by a step's
// angle from one to the next.
void PowerOfSteps(const ArrayXd& residual, const ArrayXd& place, double w,
                  const Waves& step, int count, double* power) {
  const Waves first(w * place);
  ArrayXd re = residual * first.cosine, im = residual * first.sine;
  ArrayXd next(re.size());
  for (int k = 0; k < count; ++k) {
    power[k] = std::norm(std::complex<double>(re.sum(), im.sum()));
    next = re * step.cosine - im * step.sine;
    im = re * step.sine + im * step.cosine;
    re.swap(next);
  }
}

// Power() at all of these, a step apart.
std::vector<double> Powers(const VectorXd& residual, const VectorXd& place,
                           const std::vector<double>& w, double step) {
  constexpr size_t kSteps = 64;  // until turns have summed up rounding errors
  std::vector<int> there;        // samples that add something
  for (int k = 0; k < residual.size(); ++k) {
    if (residual[k] != 0) there.push_back(k);
  }
  const ArrayXd r = residual(there), x = place(there);
  const Waves turn(step * x);
  std::vector<double> power(w.size());
  tbb::parallel_for(size_t{0}, (w.size() + kSteps - 1) / kSteps, [&](size_t i) {
    const size_t begin = i * kSteps;
    PowerOfSteps(r, x, w[begin], turn,
                 static_cast<int>(std::min(kSteps, w.size() - begin)),
                 &power[begin]);
  });
  return power;
}

}  // namespace

// Frequencies at which a residual has the most power along position or time,
// its largest peaks. Power is |sum r exp(i w place)|^2, the periodogram
// (Schuster 1898), which asks for no even spacing, on a grid of kOversampling
// points per resolution 2 pi / range; each peak is then searched between the
// grid's points. kMost points bound the time that long logs take, by a grid
// that is coarser.
std::vector<double> PeakFrequencies(const VectorXd& residual,
                                    const VectorXd& place, double low,
                                    double high, int count) {
  std::vector<double> found;
  if (place.size() == 0) return found;
  const double range = place.maxCoeff() - place.minCoeff();
  if (!(range > 0) || !(high > low)) return found;
  constexpr double kOversampling = 3;
  constexpr int kMost = 4000;
  const double step =
      std::max(2 * M_PI / range / kOversampling, (high - low) / kMost);
  std::vector<double> frequencies;
  for (double w = low; w <= high; w += step) frequencies.push_back(w);
  const std::vector<double> power = Powers(residual, place, frequencies, step);
  std::vector<Peak> peaks;
  for (size_t k = 0; k < power.size(); ++k) {
    if (k > 0 && power[k] < power[k - 1]) continue;
    if (k + 1 < power.size() && power[k] <= power[k + 1]) continue;
    peaks.push_back({low + k * step, power[k]});
  }
  for (const Peak& peak : Sorted(peaks)) {
    if (static_cast<int>(found.size()) == count) break;
    // Between the grid's points.
    Peak best = peak;
    for (double shift = -.75; shift <= .75; shift += .25) {
      const double w = peak.at + shift * step;
      const double here = Power(residual, place, w);
      if (w > 0 && here > best.power) best = {w, here};
    }
    found.push_back(best.at);
  }
  return found;
}

// Windows of several lengths slide over time, a quarter of their length at a
// step, and their strength is (w' r)^2 / w' w with the biweight w = (1 -
// u^2)^2, the score of a matched filter of that shape, summed over joints. The
// strongest of each length are kept, as long as they are half of one away from
// another. `searched` counts all of them, which is what one that is chosen was
// chosen from.
std::vector<TimeWindow> StrongWindows(const MatrixXd& residual,
                                      const VectorXd& t,
                                      const std::vector<double>& durations,
                                      int count, int* searched) {
  std::vector<TimeWindow> windows;
  *searched = 0;
  if (t.size() < 2) return windows;
  for (const double duration : durations) {
    std::vector<Peak> found;
    for (double c = t[0]; c < t[t.size() - 1]; c += duration / 4) {
      ++*searched;
      const auto first =
          std::lower_bound(t.begin(), t.end(), c - duration / 2) - t.begin();
      const auto size = std::lower_bound(t.begin(), t.end(), c + duration / 2) -
                        t.begin() - first;
      const ArrayXd u = (t.segment(first, size).array() - c) / (duration / 2);
      const VectorXd weight = (1 - u.square()).max(0).square().matrix();
      const double norm = weight.squaredNorm();
      if (norm < 1) continue;
      found.push_back(
          {c, (residual.middleRows(first, size).transpose() * weight)
                      .squaredNorm() /
                  norm});
    }
    int kept = 0;
    std::vector<double> centres;
    for (const Peak& peak : Sorted(found)) {
      if (kept == count) break;
      const bool near = std::any_of(
          centres.begin(), centres.end(),
          [&](double c) { return std::abs(c - peak.at) < duration / 2; });
      if (near) continue;
      centres.push_back(peak.at);
      windows.push_back({peak.at, duration, peak.power});
      ++kept;
    }
  }
  return windows;
}

namespace {

// A raised cosine of mean 1 (Hann). It has side lobes far below those of no
// window, so that a peak of a large and slow motion does not leak into the
// frequency that is looked at, and it keeps the amplitude of an oscillation of
// the whole signal.
VectorXd Windowed(const VectorXd& signal, const VectorXd& t) {
  const double range = t.maxCoeff() - t.minCoeff();
  const Waves waves(2 * M_PI / range * (t.array() - t.minCoeff()));
  return (signal.array() - signal.mean()) * (1 - waves.cosine);
}

}  // namespace

double AmplitudeAt(const VectorXd& signal, const VectorXd& t,
                   double frequency) {
  return 2 / static_cast<double>(t.size()) *
         std::sqrt(Power(Windowed(signal, t), t, 2 * M_PI * frequency));
}

double PowerOverNeighbours(const VectorXd& signal, const VectorXd& t,
                           double frequency) {
  const VectorXd windowed = Windowed(signal, t);
  const auto power = [&](double f) { return Power(windowed, t, 2 * M_PI * f); };
  double around = 0;
  for (const double away : {.2, .4, .6, .8, 1.}) {
    around += power(frequency - away) + power(frequency + away);
  }
  return power(frequency) / std::max(1e-300, around / 10);
}

}  // namespace armcal
