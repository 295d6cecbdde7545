#include "calib/diagnose/data/rows.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

constexpr double kRateOverBandwidth = 2.5;
constexpr int kShortestRun = 3 * Autoregression::kOrder;

// Into how many blocks `size` samples are cut for folds: as many as hold
// `guards` samples and a run.
int NumBlocks(double size, double guards) {
  for (const int blocks : {10, 7, 4, 3}) {
    if (size / blocks >= kShortestRun + guards) return blocks;
  }
  return 1;
}

}  // namespace

// Samples are thinned to 2.5 times the bandwidth, above which the low pass
// leaves nothing, and whole periods of the bandwidth at both ends of a segment
// are skipped, where the filter has no neighbours.
GapRows::GapRows(const std::vector<GapSegment>& segments, double bandwidth_hz,
                 LogPart part)
    : segments_(segments), bandwidth_hz_(bandwidth_hz), part_(part) {
  CHECK_GT(bandwidth_hz, 0);
  int begin = 0;
  for (const GapSegment& segment : segments) {
    const double rate = 1 / segment.motion.dt;
    stride_.push_back(std::max(
        1, static_cast<int>(
               std::floor(rate / (kRateOverBandwidth * bandwidth_hz) + 1e-6))));
    skip_.push_back(
        static_cast<int>(std::ceil(kPeriodsAtEnds / bandwidth_hz * rate)));
    thin_begin_.push_back(begin);
    begin += std::max(
        0, (segment.size() - 1 - 2 * skip_.back()) / stride_.back() + 1);
  }
  thin_begin_.push_back(begin);
  for (size_t i = 0; i < segments.size(); ++i) {
    const int s = static_cast<int>(i);
    blocks_.push_back(NumBlocks(thin_begin_[s + 1] - thin_begin_[s],
                                kPeriodsAtEnds / bandwidth_hz / step(s)));
  }
  MakeRuns();
  reconstructed_stddev_ =
      Limits().reconstructed_torque_stddev * UsualTorque(segments, true);
  for (size_t i = 0; i < segments.size(); ++i) {
    const int s = static_cast<int>(i), first = thin_begin_[i];
    drift_.emplace_back();
    if (!segments[i].torque_drifts) continue;
    Eigen::VectorXd times(thin_begin_[i + 1] - first);
    for (int k = 0; k < times.size(); ++k) times[k] = thin_time(s, first + k);
    drift_.back().emplace(times);
  }
}

double GapRows::Shortest(double bandwidth_hz) {
  return (kShortestRun / kRateOverBandwidth + 2 * kPeriodsAtEnds) /
         bandwidth_hz;
}

double GapRows::ShortestSplit(double bandwidth_hz) {
  // Three blocks with guards on both sides of a run, and the bent ends.
  const double block = kPeriodsAtEnds + kShortestRun / kRateOverBandwidth;
  return (3 * block + 2 * kPeriodsAtEnds) / bandwidth_hz;
}

// Blocks of a segment: of those that are predicted the edges are guarded.
bool GapRows::IsInPart(int segment, int k) const {
  if (part_.rows == LogPart::Rows::kAll) return true;
  const int within = k - thin_begin_[segment];
  const int size = thin_begin_[segment + 1] - thin_begin_[segment];
  const double guard = kPeriodsAtEnds / bandwidth_hz_ / 2 / step(segment);
  const int blocks = blocks_[segment];
  const double length = static_cast<double>(size) / blocks;
  const int block = std::min(blocks - 1, static_cast<int>(within / length));
  const bool is_split = blocks >= LogPart::kFolds;
  const bool in_fold = is_split && block % LogPart::kFolds == part_.fold;
  if (part_.rows == LogPart::Rows::kOtherFolds) return !in_fold;
  const double from_edge =
      std::min(within - block * length, (block + 1) * length - within);
  const bool is_predicted =
      part_.rows == LogPart::Rows::kAnyFold ? is_split : in_fold;
  return is_predicted && from_edge >= guard;
}

bool GapRows::IsHeld(int segment, int joint, int k) const {
  const int sample =
      skip_[segment] + (k - thin_begin_[segment]) * stride_[segment];
  return segments_[segment].still(sample, joint) ||
         segments_[segment].BreaksAway(sample, joint);
}

// A sample of which the joint rests tells the noise and not the torque; one in
// which it breaks away from a rest tells neither, since its friction is then on
// its way from what holds it to what brakes it.
GapRows::Use GapRows::UseOf(int segment, int joint, int k) const {
  if (!IsInPart(segment, k)) return Use::kNone;
  if (!IsHeld(segment, joint, k)) return Use::kMoving;
  const int sample =
      skip_[segment] + (k - thin_begin_[segment]) * stride_[segment];
  return segments_[segment].BreaksAway(sample, joint) ? Use::kNone
                                                      : Use::kStill;
}

// Runs of samples that are uninterrupted and used alike, of kShortestRun and
// longer: an autoregression needs as many samples before the first whitened one
// as it remembers, and a run shorter than a few times that would be all of what
// comes before it.
void GapRows::MakeRuns() {
  const int n = segments_.empty() ? 0 : segments_[0].motion.num_joints();
  runs_.resize(n);
  still_runs_.resize(n);
  for (int j = 0; j < n; ++j) {
    for (size_t i = 0; i < segments_.size(); ++i) {
      const int s = static_cast<int>(i);
      const int end = thin_begin_[s + 1];
      int begin = thin_begin_[s];
      for (int k = begin + 1; k <= end; ++k) {
        const Use use = UseOf(s, j, begin);
        if (k < end && UseOf(s, j, k) == use) continue;
        if (k - begin >= kShortestRun && use != Use::kNone) {
          (use == Use::kStill ? still_runs_ : runs_)[j].push_back(
              {s, begin, k - begin});
        }
        begin = k;
      }
    }
  }
}

double GapRows::step(int segment) const {
  return stride_[segment] * segments_[segment].motion.dt;
}

double GapRows::time() const {
  double time = 0;
  for (size_t i = 0; i < segments_.size(); ++i) {
    const int s = static_cast<int>(i);
    time += (thin_begin_[s + 1] - thin_begin_[s]) * step(s);
  }
  return time;
}

int GapRows::SegmentOf(int thin) const {
  const auto after =
      std::upper_bound(thin_begin_.begin(), thin_begin_.end(), thin);
  return static_cast<int>(after - thin_begin_.begin()) - 1;
}

double GapRows::thin_time(int segment, int k) const {
  return segments_[segment].motion.time(
      skip_[segment] + (k - thin_begin_[segment]) * stride_[segment]);
}

MatrixXd GapRows::Pick(int segment, const MatrixXd& signal) const {
  CHECK_EQ(signal.rows(), segments_[segment].size());
  MatrixXd thin(thin_begin_[segment + 1] - thin_begin_[segment], signal.cols());
  for (int k = 0; k < thin.rows(); ++k) {
    thin.row(k) = signal.row(skip_[segment] + k * stride_[segment]);
  }
  return thin;
}

// The zero-phase low pass runs over all of a segment and is then thinned: a
// filter of one part of it would bend its ends.
MatrixXd GapRows::Thin(int segment, const MatrixXd& signal) const {
  return Pick(segment,
              ZeroPhaseLowPass(signal, 1 / segments_[segment].motion.dt,
                               bandwidth_hz_));
}

MatrixXd GapRows::Thin(
    int segment, const std::vector<const Eigen::VectorXd*>& signals) const {
  return ThinnedLowPass(signals, 1 / segments_[segment].motion.dt,
                        bandwidth_hz_, skip_[segment], stride_[segment],
                        thin_begin_[segment + 1] - thin_begin_[segment]);
}

// Rows are whitened by the joint's autoregression, and weighed by sqrt(v / (v +
// extra^2)), v the noise's variance: what else may be wrong with a sample is
// white and known for itself. Reconstructed torques are known to a share of
// their usual size at best, which is white noise added to theirs.
void GapRows::SetNoise(std::vector<Autoregression> noise,
                       const MatrixXd& extra_stddev) {
  CHECK_EQ(static_cast<int>(noise.size()), num_joints());
  CHECK_EQ(extra_stddev.rows(), num_thin());
  noise_ = std::move(noise);
  for (int j = 0; j < num_joints(); ++j) {
    if (reconstructed_stddev_[j] > 0)
      noise_[j] = PlusWhite(noise_[j], reconstructed_stddev_[j]);
  }
  variance_ = extra_stddev.cwiseAbs2();
  weight_.resize(num_thin(), num_joints());
  for (int j = 0; j < num_joints(); ++j) {
    const double own = std::pow(noise_[j].stddev(), 2);
    variance_.col(j).array() += own;
    weight_.col(j) = (own / variance_.col(j).array()).sqrt();
  }
}

// The same with white noise of these deviations in place of the autoregression,
// for questions about how likely a model is (evidence_noise.h).
void GapRows::SetEvidence(const Eigen::VectorXd& stddev,
                          const MatrixXd& extra_stddev) {
  CHECK_EQ(stddev.size(), num_joints());
  CHECK_EQ(extra_stddev.rows(), num_thin());
  evidence_ = stddev;
  evidence_weight_.resize(num_thin(), num_joints());
  for (int j = 0; j < num_joints(); ++j) {
    const double own = stddev[j] * stddev[j];
    evidence_weight_.col(j) =
        (own / (own + extra_stddev.col(j).array().square())).sqrt();
  }
}

void GapRows::ScaleEvidence(const Eigen::VectorXd& factor) {
  evidence_ = evidence_.cwiseProduct(factor);
}

int GapRows::num_rows(int joint) const {
  int rows = 0;
  for (const Run& run : runs_[joint]) rows += run.size - Autoregression::kOrder;
  return rows;
}

int GapRows::num_rows() const {
  int rows = 0;
  for (int j = 0; j < num_joints(); ++j) rows += num_rows(j);
  return rows;
}

// A torque whose integrals began anywhere has a level that walks at random
// (torque_drift.h). That level is told by a fit of broken lines where the joint
// moves, weighed as its rows are, and taken off all columns of `thin` alike;
// torque that is not known keeps its NaN.
MatrixXd GapRows::WithoutDrift(int joint, const MatrixXd& thin) const {
  CHECK_EQ(thin.rows(), num_thin());
  MatrixXd without = thin;
  if (std::none_of(segments_.begin(), segments_.end(),
                   [](const GapSegment& s) { return s.torque_drifts; })) {
    return without;
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(num_thin());
  for (const Run& run : runs_[joint]) {
    auto of_run = weights.segment(run.begin, run.size);
    of_run.setOnes();
    if (weight_.size() == 0) continue;
    of_run = weight_.col(joint).segment(run.begin, run.size).cwiseAbs2();
  }
  for (int k = 0; k < num_thin(); ++k) {
    if (!thin.row(k).allFinite()) weights[k] = 0;
  }
  for (size_t i = 0; i < drift_.size(); ++i) {
    if (!drift_[i]) continue;
    const int begin = thin_begin_[i], size = thin_begin_[i + 1] - begin;
    without.middleRows(begin, size) = drift_[i]->Without(
        thin.middleRows(begin, size), weights.segment(begin, size));
  }
  return without;
}

// Rows of all runs of a joint, one below the other, each run whitened for
// itself: between runs there is no time over which noise could be predicted.
template <typename Rows>
MatrixXd GapRows::RowsOfRuns(int joint, const MatrixXd& thin,
                             const MatrixXd& weight, Rows rows_of_run) const {
  MatrixXd rows(num_rows(joint), thin.cols());
  int at = 0;
  for (const Run& run : runs_[joint]) {
    const int size = run.size - Autoregression::kOrder;
    rows.middleRows(at, size) =
        weight.col(joint)
            .segment(run.begin + Autoregression::kOrder, size)
            .asDiagonal() *
        rows_of_run(thin.middleRows(run.begin, run.size));
    at += size;
  }
  return rows;
}

MatrixXd GapRows::Whiten(int joint, const MatrixXd& signals) const {
  if (!has_evidence()) return WhitenByNoise(joint, signals);
  return RowsOfRuns(
      joint, WithoutDrift(joint, signals), evidence_weight_,
      [&](const MatrixXd& run) -> MatrixXd {
        return run.bottomRows(run.rows() - Autoregression::kOrder) /
               evidence_[joint];
      });
}

MatrixXd GapRows::WhitenByNoise(int joint, const MatrixXd& signals) const {
  return RowsOfRuns(
      joint, WithoutDrift(joint, signals), weight_,
      [&](const MatrixXd& run) { return noise_[joint].Whiten(run); });
}

MatrixXd GapRows::Stacked(const std::vector<MatrixXd>& signals,
                          OfSegment part) const {
  MatrixXd all(num_thin(), signals.at(0).cols());
  for (size_t i = 0; i < signals.size(); ++i) {
    const int s = static_cast<int>(i);
    const MatrixXd thin = (this->*part)(s, signals[i]);
    all.middleRows(thin_begin_[s], thin.rows()) = thin;
  }
  return all;
}

MatrixXd GapRows::ThinAll(const std::vector<MatrixXd>& signals) const {
  return Stacked(signals, &GapRows::Thin);
}

MatrixXd GapRows::PickAll(const std::vector<MatrixXd>& signals) const {
  return Stacked(signals, &GapRows::Pick);
}

std::vector<GapRows::Place> GapRows::PlacesOfRows(int joint) const {
  std::vector<Place> places;
  for (const Run& run : runs_[joint]) {
    for (int k = Autoregression::kOrder; k < run.size; ++k) {
      const int sample = run.begin + k;
      places.push_back({sample, run.segment, thin_time(run.segment, sample)});
    }
  }
  return places;
}

std::vector<int> GapRows::SampleOfRow(int joint) const {
  std::vector<int> samples;
  for (const Run& run : runs_[joint]) {
    for (int k = Autoregression::kOrder; k < run.size; ++k) {
      samples.push_back(run.begin + k);
    }
  }
  return samples;
}

}  // namespace armcal
