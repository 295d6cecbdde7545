#include "calib/logs/sample_noise.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "calib/logs/repeated_motion.h"
#include "calib/numerics/robust_rows.h"

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr long kKept = 60000;  // samples of all logs, so that memory is bounded
constexpr int kLeastStretch = 20;  // samples
constexpr long kLeastSamples = 100;
constexpr double kLeastLag = 0.5;  // s

// The samples of one log that are kept.
struct Kept {
  RecordedMotion motion;
  MatrixXd residuals;       // NaN for outliers
  std::vector<bool> still;  // the arm stands
};

VectorXd WithoutLine(const VectorXd& y) {
  MatrixXd line(y.size(), 2);
  line.col(0).setOnes();
  line.col(1).setLinSpaced(-1, 1);
  return y - line * line.householderQr().solve(y);
}

class Collector {
 public:
  Collector(int joints, int num_logs, const OutlierLists& outliers)
      : outliers_(outliers),
        most_(kKept / num_logs),
        kept_(num_logs),
        residual_(joints),
        standstill_(joints),
        repeats_(joints) {}

  void Add(int log, const Trajectory& t, MatrixXd residuals) {
    MarkOutliers(log, t, &residuals);
    std::vector<Index> core;
    std::vector<bool> still;
    for (int k = 0; k < t.samples.size(); ++k) {
      const double place = t.samples.place[k];
      if (place < t.core_begin || place >= t.core_end) continue;
      core.push_back(k);
      still.push_back(t.standstill[GridRow(t, k)]);
    }
    for (Index i = 0; i < residuals.cols(); ++i) {
      const VectorXd tau = t.samples.tau.col(i)(core);
      const VectorXd r = residuals.col(i)(core);
      AddStandstill(tau, r, still, &standstill_[i]);
      for (const double v : r) {
        if (!std::isnan(v)) residual_[i].Add(v);
      }
    }
    Keep(log, t, residuals, core, still);
  }

  std::vector<SampleNoise> Noise() {
    AddRepeats();
    std::vector<SampleNoise> noise;
    for (size_t i = 0; i < residual_.size(); ++i) noise.push_back(NoiseOf(i));
    return noise;
  }

 private:
  using Source = SampleNoise::Source;

  static int GridRow(const Trajectory& t, int sample) {
    return std::clamp(static_cast<int>(std::lround(t.samples.place[sample])), 0,
                      t.size() - 1);
  }

  void MarkOutliers(int log, const Trajectory& t, MatrixXd* residuals) const {
    if (outliers_.empty()) return;
    const std::vector<long>& rows = t.samples.row;
    for (const TorqueOutlier& o : outliers_[log]) {
      const auto at = std::lower_bound(rows.begin(), rows.end(), o.row);
      if (at == rows.end() || *at != o.row) continue;
      (*residuals)(at - rows.begin(), o.joint) = std::nan("");
    }
  }

  // Torque about a straight line in each stretch of standstill.
  static void AddStandstill(const VectorXd& tau, const VectorXd& residuals,
                            const std::vector<bool>& still,
                            ResidualStatistics* statistics) {
    std::vector<double> stretch;
    for (size_t k = 0; k <= still.size(); ++k) {
      if (k < still.size() && still[k]) {
        if (!std::isnan(residuals[k])) stretch.push_back(tau[k]);
        continue;
      }
      if (stretch.size() >= kLeastStretch) {
        for (const double v : WithoutLine(Eigen::Map<VectorXd>(
                 stretch.data(), static_cast<Index>(stretch.size())))) {
          statistics->Add(v);
        }
      }
      stretch.clear();
    }
  }

  void Keep(int log, const Trajectory& t, const MatrixXd& residuals,
            const std::vector<Index>& core, const std::vector<bool>& still) {
    Kept& kept = kept_[log];
    const Index old = kept.motion.t.size();
    const Index more =
        std::min<Index>(static_cast<Index>(core.size()), most_ - old);
    if (more <= 0) return;
    kept.motion.t.conservativeResize(old + more);
    kept.motion.q.conservativeResize(old + more, t.num_joints());
    kept.residuals.conservativeResize(old + more, t.num_joints());
    for (Index k = 0; k < more; ++k) {
      const int sample = static_cast<int>(core[k]);
      kept.motion.t[old + k] = t.samples.t[sample];
      kept.motion.q.row(old + k) = t.q.row(GridRow(t, sample));
      kept.residuals.row(old + k) = residuals.row(sample);
      kept.still.push_back(still[k]);
    }
  }

  void AddRepeats() {
    for (size_t a = 0; a < kept_.size(); ++a) {
      for (size_t b = a; b < kept_.size(); ++b) {
        const auto lag = FindRepeat(
            kept_[a].motion, kept_[b].motion,
            a == b ? kLeastLag : -std::numeric_limits<double>::infinity());
        if (lag) AddDifferences(kept_[a], kept_[b], *lag);
      }
    }
  }

  void AddDifferences(const Kept& a, const Kept& b, double lag) {
    const VectorXd& t = a.motion.t;
    const double dt =
        (t[t.size() - 1] - t[0]) / static_cast<double>(t.size() - 1);
    for (Index k = 0; k < t.size(); ++k) {
      const Index other = NearestSample(b.motion.t, t[k] + lag);
      if (std::abs(b.motion.t[other] - t[k] - lag) > 0.6 * dt) continue;
      if (a.still[k] || b.still[other]) continue;
      for (size_t i = 0; i < repeats_.size(); ++i) {
        const double d = b.residuals(other, static_cast<Index>(i)) -
                         a.residuals(k, static_cast<Index>(i));
        if (!std::isnan(d)) repeats_[i].Add(d / std::sqrt(2.0));
      }
    }
  }

  // A source must have enough samples, and see any noise: torque that stands
  // still to the last digit is a display's, not a sensor's.
  SampleNoise NoiseOf(size_t joint) const {
    const double whole = residual_[joint].RobustSpread();
    for (const auto& [source, statistics] :
         {std::make_pair(Source::kRepeats, &repeats_[joint]),
          std::make_pair(Source::kStandstill, &standstill_[joint])}) {
      const double spread = statistics->RobustSpread();
      if (statistics->count() < kLeastSamples || spread < 1e-6 * whole) {
        continue;
      }
      return {source, spread, statistics->count()};
    }
    return {Source::kResidual, whole, residual_[joint].count()};
  }

  const OutlierLists& outliers_;
  Index most_;
  std::vector<Kept> kept_;
  std::vector<ResidualStatistics> residual_, standstill_, repeats_;
};

}  // namespace

const char* NoiseSourceName(SampleNoise::Source source) {
  switch (source) {
    case SampleNoise::Source::kRepeats:
      return "repeats";
    case SampleNoise::Source::kStandstill:
      return "standstill";
    case SampleNoise::Source::kResidual:
      return "residual";
  }
  return "";
}

std::vector<SampleNoise> EstimateSampleNoise(const OutlierLists& outliers,
                                             SamplePass* pass) {
  Collector collector(pass->num_joints(), pass->num_logs(), outliers);
  pass->Run("noise",
            [&](int log, const Trajectory& t, const SampleResiduals& r) {
              collector.Add(log, t, r.residual);
            });
  return collector.Noise();
}

}  // namespace armcal
