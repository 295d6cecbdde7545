#include "calib/diagnose/candidates/proposals.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

constexpr int kPeaks = 3;
constexpr int kWindows = 3;
// Per rad: slower ones are springs and cables.
constexpr double kLowestHarmonic = 6, kHighestHarmonic = 130;
// Of the bandwidth: beyond it the low pass leaves nothing of a vibration.
constexpr double kHighestFrequency = 4;
constexpr double kLeastPassed = .3;  // of a vibration's amplitude
const std::vector<double> kDurations = {.15, .4, 1};  // s

// Of the low pass (low_pass.h).
double GainAt(double f, double bandwidth_hz) {
  return 1 / (1 + std::pow(f / bandwidth_hz, 8));
}

}  // namespace

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Residuals in units of each joint's noise, 0 where it rests, against position
// and time. Standstill is not part of a vibration, and its samples would add
// their own noise to every frequency.
GapProposals::GapProposals(const GapRows& rows, const MatrixXd& residual)
    : rows_(rows) {
  const int n = rows.num_joints();
  q_.resize(rows.num_thin(), n);
  t_.resize(rows.num_thin());
  for (size_t s = 0; s < rows.segments().size(); ++s) {
    const int begin = rows.thin_begin(static_cast<int>(s));
    const MatrixXd q =
        rows.Pick(static_cast<int>(s), rows.segments()[s].motion.q);
    q_.middleRows(begin, q.rows()) = q;
    for (int k = 0; k < q.rows(); ++k) {
      t_[begin + k] = rows.thin_time(static_cast<int>(s), begin + k);
    }
  }
  whitened_ = residual;
  for (int j = 0; j < n; ++j) {
    const double scale = rows.noise(j).stddev();
    if (scale > 0) whitened_.col(j) /= scale;
    std::vector<bool> moves(rows.num_thin(), false);
    for (const int k : rows.SampleOfRow(j)) moves[k] = true;
    for (int k = 0; k < rows.num_thin(); ++k) {
      if (!moves[k]) whitened_(k, j) = 0;
    }
  }
}

std::vector<double> GapProposals::Harmonics(int joint) const {
  if (joint < 0) return {};
  const double range = q_.col(joint).maxCoeff() - q_.col(joint).minCoeff();
  if (!(range > 0)) return {};
  return PeakFrequencies(whitened_.col(joint), q_.col(joint),
                         std::max(kLowestHarmonic, 2 * M_PI / range),
                         kHighestHarmonic, kPeaks);
}

std::vector<double> GapProposals::Frequencies(int joint) const {
  if (joint < 0) return {};
  std::vector<double> f =
      PeakFrequencies(whitened_.col(joint), t_, 2 * M_PI * .5,
                      2 * M_PI * 1.25 * rows_.bandwidth_hz(), kPeaks);
  for (double& x : f) x = Unaliased(joint, x / (2 * M_PI));
  f.erase(std::remove_if(f.begin(), f.end(),
                         [this](double x) { return IsOfMotion(x); }),
          f.end());
  return f;
}

// Whether a sine at f has kShareOfMotion of the variance of a joint's velocity,
// in one stretch of log: A^2 / 2 of its amplitude A. Of pendulums it has .3 and
// more, of sums of five harmonics at most .23.
bool GapProposals::IsOfMotion(double f) const {
  constexpr double kShareOfMotion = .25;
  for (const GapSegment& segment : rows_.segments()) {
    const Motion& motion = segment.motion;
    const VectorXd t =
        VectorXd::LinSpaced(motion.size(), 0, (motion.size() - 1) * motion.dt);
    for (int j = 0; j < motion.num_joints(); ++j) {
      const VectorXd v = motion.qd.col(j).array() - motion.qd.col(j).mean();
      const double variance = v.squaredNorm() / static_cast<double>(v.size());
      const double amplitude = AmplitudeAt(v, t, f);
      if (amplitude * amplitude / 2 > kShareOfMotion * variance) return true;
    }
  }
  return false;
}

// Samples that are thinned to `rate` cannot tell f from rate - f and rate + f.
// The unthinned recorded torque can: the frequency is the one of the three at
// which it has the most power over its neighbourhood, of those where the low
// pass leaves at least kLeastPassed of the amplitude that the thinned residual
// has. Beyond kHighestFrequency times the bandwidth it leaves nothing.
double GapProposals::Unaliased(int joint, double f) const {
  const auto& segments = rows_.segments();
  const auto longest =
      std::max_element(segments.begin(), segments.end(),
                       [](const GapSegment& a, const GapSegment& b) {
                         return a.size() < b.size();
                       });
  const int s = static_cast<int>(longest - segments.begin());
  const double rate = 1 / rows_.step(s), dt = longest->motion.dt;
  const VectorXd t =
      VectorXd::LinSpaced(longest->size(), 0, (longest->size() - 1) * dt);
  const int begin = rows_.thin_begin(s), size = rows_.thin_begin(s + 1) - begin;
  const double left = rows_.noise(joint).stddev() *
                      AmplitudeAt(whitened_.col(joint).segment(begin, size),
                                  t_.segment(begin, size), f);
  double best = f, most = 0;
  for (const double alias : {f, rate - f, rate + f}) {
    if (alias > std::min(kHighestFrequency * rows_.bandwidth_hz(), .4 / dt)) {
      continue;
    }
    const double passed = GainAt(alias, rows_.bandwidth_hz()) *
                          AmplitudeAt(longest->tau.col(joint), t, alias);
    if (passed < kLeastPassed * left) continue;
    const double power = PowerOverNeighbours(longest->tau.col(joint), t, alias);
    if (power > most) most = power, best = alias;
  }
  return best;
}

int GapProposals::num_logs() const {
  return rows_.segments().empty() ? 0 : rows_.segments().back().log + 1;
}

std::vector<TimeWindow> GapProposals::Windows(int log, int* searched) const {
  std::vector<int> samples;
  for (size_t s = 0; s < rows_.segments().size(); ++s) {
    if (rows_.segments()[s].log != log) continue;
    const int part = static_cast<int>(s);
    for (int k = rows_.thin_begin(part); k < rows_.thin_begin(part + 1); ++k) {
      samples.push_back(k);
    }
  }
  return StrongWindows(whitened_(samples, Eigen::all), t_(samples), kDurations,
                       kWindows, searched);
}

}  // namespace armcal
