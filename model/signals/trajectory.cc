#include "model/signals/trajectory.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/signals/low_pass.h"
#include "model/signals/resampler.h"
#include "model/signals/spikes.h"
#include "model/signals/standstill.h"
#include "model/signals/torque_samples.h"

namespace armcal {
namespace {

constexpr double kCoreTime = 16;  // s
constexpr long kMaxCore = 20000;  // samples

// Every factor-th sample.
Eigen::MatrixXd Thin(const Eigen::MatrixXd& x, long factor) {
  Eigen::MatrixXd y((x.rows() + factor - 1) / factor, x.cols());
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    for (Eigen::Index k = 0; k < y.rows(); ++k) y(k, c) = x(k * factor, c);
  }
  return y;
}

}  // namespace

std::size_t BytesOf(const Trajectory& t) {
  Eigen::Index numbers = t.samples.t.size() + t.samples.place.size() +
                         t.samples.tau.size() + t.standstill.size();
  for (const Eigen::MatrixXd* x :
       {&t.q, &t.qd, &t.qdd, &t.friction_q, &t.friction_qd, &t.tau,
        &t.tau_recorded, &t.temperature, &t.wrench, &t.current}) {
    numbers += x->size();
  }
  return (static_cast<std::size_t>(numbers) + t.samples.row.size()) *
         sizeof(double);
}

struct TrajectoryReader::Impl {
  Impl(KeptLog* log_in, const TimeBase& time_base,
       const TrajectoryOptions& options_in)
      : log(log_in),
        options(options_in),
        outliers(options_in.outliers != nullptr &&
                 !options_in.outliers->empty()),
        base(time_base),
        bandwidth(options_in.bandwidth_hz),
        resampler(base.dt, base.uniform),
        recorded(base.dt, base.uniform),
        samples(base.dt, base.uniform) {
    const double whole = base.range.end - base.range.begin;
    const double reach = std::min(options.reach_s, whole) + kStandstillTime +
                         4 * base.dt +
                         (bandwidth > 0 ? 2 * LowPassMemory(bandwidth) : 0);
    if (bandwidth > 0 && !options.every_sample) {
      thin = std::max(1L, static_cast<long>(1 / (16 * bandwidth * base.dt)));
    }
    margin = Whole(static_cast<long>(std::ceil(reach / base.dt)));
    core =
        Whole(std::clamp(static_cast<long>(kCoreTime / base.dt), 1L, kMaxCore));
    largest_step = 3 * base.median_step;
    if (bandwidth > 0) {
      largest_step = std::max(largest_step, 0.25 / bandwidth);
    }
    largest_step = std::max(largest_step, options.longest_gap_s);
  }

  // Reads samples of the current segment until grid point `index` is within
  // the four-sample neighbourhood of what has been read, or the segment ends.
  void FillTo(long index);
  // How many rows of the block, the next one first, follow each other without
  // need to look at what has been read.
  int RunLength(long index) const;
  void Restart() {
    log->Rewind();
    Clear();
    block = nullptr;
    block_row = 0;
    segment = -1;
    next_core = 0;
    segment_ended = true;
    log_ended = false;
  }
  bool NextBlock() {
    block_row = 0;
    block = log->Next();
    log_ended = block == nullptr;
    if (outliers && !log_ended) {
      as_recorded.t = block->t;
      as_recorded.tau = block->tau;
      replaced = *block;
      ReplaceOutliers(*options.outliers, &replaced);
      block = &replaced;
    }
    return !log_ended;
  }
  void Clear() {
    resampler.Clear();
    recorded.Clear();
    samples.Clear();
  }
  void Append(int row, int count) {
    resampler.Append(*block, row, count);
    if (outliers) recorded.Append(as_recorded, row, count);
    if (options.every_sample) samples.Append(*block, row, count);
  }
  void DropBefore(long index) {
    resampler.DropBefore(index);
    if (outliers) recorded.DropBefore(index);
    samples.DropBefore(index);
  }
  void SetTorque(long begin, long end, long core_begin, long core_end,
                 Eigen::MatrixXd tau, Trajectory* t) const;
  // The next multiple of `thin`, to which the borders of stretches are held.
  long Whole(long samples) const { return (samples + thin - 1) / thin * thin; }
  Trajectory Make(long core_begin, long core_end, long available);

  KeptLog* log;
  TrajectoryOptions options;
  bool outliers;  // there are some
  TimeBase base;
  double bandwidth;
  Resampler resampler;
  Resampler recorded;  // torque with its outliers, where they are known
  TorqueSampleWindow samples;
  long thin = 1;  // one sample in so many is kept
  long margin, core;
  double largest_step;

  const Log* block = nullptr;
  Log replaced;     // the block, its outliers replaced
  Log as_recorded;  // its torque before
  int block_row = 0;
  int segment = -1;
  long next_core = 0;
  bool segment_ended = true;
  bool log_ended = false;
};

void TrajectoryReader::Impl::FillTo(long index) {
  while (!segment_ended) {
    if (!resampler.empty() && resampler.NumGridPoints() > index + 4) return;
    if ((block == nullptr || block_row >= block->size()) && !NextBlock()) {
      segment_ended = true;
      return;
    }
    const double t = block->t[block_row];
    if (!options.crop.Contains(t)) {
      ++block_row;
      continue;
    }
    if (!resampler.empty()) {
      if (t == resampler.last_time()) {  // duplicate
        ++block_row;
        continue;
      }
      if (t - resampler.last_time() > largest_step) {
        segment_ended = true;  // the row opens the next segment
        return;
      }
    }
    const int count = RunLength(index);
    Append(block_row, count);
    block_row += count;
  }
}

int TrajectoryReader::Impl::RunLength(long index) const {
  int count = 1;
  if (resampler.empty()) return count;
  for (int row = block_row + 1; row < block->size(); ++row, ++count) {
    const double last = block->t[row - 1], t = block->t[row];
    if (resampler.NumGridPointsWith(last, count) > index + 4) break;
    if (!options.crop.Contains(t) || t == last || t - last > largest_step) {
      break;
    }
  }
  return count;
}

// Torque of grid points [begin, end), as the fit takes it and as recorded.
void TrajectoryReader::Impl::SetTorque(long begin, long end, long core_begin,
                                       long core_end, Eigen::MatrixXd tau,
                                       Trajectory* t) const {
  t->tau = std::move(tau);
  t->tau_recorded = t->tau;
  if (options.every_sample) t->samples = samples.Between(begin, end);
  if (outliers) {
    Log grid;
    recorded.Sample(begin, end, &grid);
    t->tau_recorded = std::move(grid.tau);
  } else if (options.outliers == nullptr && options.remove_spikes &&
             bandwidth > 0 && t->tau.size() > 0) {
    t->spikes = RemoveSpikes(&t->tau)
                    .middleRows(core_begin - begin, core_end - core_begin)
                    .cast<long>()
                    .colwise()
                    .sum();
  }
}

Trajectory TrajectoryReader::Impl::Make(long core_begin, long core_end,
                                        long available) {
  const long begin = std::max(0L, core_begin - margin);
  const long end = std::min(available, core_end + margin);
  Log grid;
  Trajectory t;
  if (bandwidth > 0) {
    t.position_spikes = resampler.RemovePositionSpikes(segment_ended);
  }
  resampler.Sample(begin, end, &grid);
  t.t0 = grid.t[0];
  t.dt = base.dt;
  const bool raw = bandwidth <= 0;
  SetTorque(begin, end, core_begin, core_end, std::move(grid.tau), &t);
  const auto low_passed = [&](double cutoff_hz) {
    return ZeroPhaseLowPass(grid.q, 1 / base.dt, cutoff_hz, Ends::kExtrapolate);
  };
  // Standstill is judged on what the band of the fit has not smeared.
  const double wide = kTorqueBand * bandwidth;
  Eigen::MatrixXd wide_q, velocity = grid.qd;
  if (!raw) {
    wide_q = low_passed(wide);
    velocity = MeanVelocity(wide_q, base.dt);
  }
  if (!raw && options.friction) {
    const auto [position_hz, velocity_hz] = *options.friction;
    t.friction_q =
        position_hz == wide ? std::move(wide_q) : low_passed(position_hz);
    t.friction_qd = Differentiate(
        velocity_hz == position_hz ? t.friction_q : low_passed(velocity_hz),
        t.dt);
  }
  const bool recorded = raw && velocity.size() > 0;
  if (velocity.size() == 0) velocity = MeanVelocity(grid.q, base.dt);
  t.q = raw ? std::move(grid.q) : low_passed(bandwidth);
  t.qd =
      raw && grid.qd.size() > 0 ? std::move(grid.qd) : Differentiate(t.q, t.dt);
  t.qdd = raw && grid.qdd.size() > 0 ? std::move(grid.qdd)
                                     : Differentiate(t.qd, t.dt);
  t.temperature = std::move(grid.temperature);
  t.current = std::move(grid.current);
  // As the positions are, so that it goes with the accelerations made of them.
  t.wrench = raw || grid.wrench.size() == 0
                 ? std::move(grid.wrench)
                 : ZeroPhaseLowPass(grid.wrench, 1 / base.dt, bandwidth);
  if (thin > 1) {
    const bool as_recorded = t.tau == t.tau_recorded;
    for (Eigen::MatrixXd* x : {&t.tau, &t.tau_recorded, &t.current}) {
      if (x->size() == 0) continue;
      *x = x == &t.tau_recorded && as_recorded
               ? t.tau
               : Thin(ZeroPhaseLowPass(*x, 1 / t.dt, wide), thin);
    }
    for (Eigen::MatrixXd* x :
         {&t.q, &t.qd, &t.qdd, &t.friction_q, &t.friction_qd, &t.temperature,
          &t.wrench, &velocity}) {
      *x = Thin(*x, thin);
    }
    t.dt *= static_cast<double>(thin);
    t.thinned = true;
  }
  t.segment = segment;
  t.first_index = begin / thin;
  t.core_begin = static_cast<int>((core_begin - begin) / thin);
  t.core_end = static_cast<int>((core_end - begin + thin - 1) / thin);
  t.standstill = FindStandstill(
      velocity, t.dt,
      recorded ? 0 : static_cast<int>(kStandstillMeanTime / 2 / t.dt));
  return t;
}

TrajectoryReader::TrajectoryReader(KeptLog* log, const TimeBase& time_base,
                                   const TrajectoryOptions& options)
    : impl_(std::make_unique<Impl>(log, time_base, options)) {}
TrajectoryReader::~TrajectoryReader() = default;
TrajectoryReader::TrajectoryReader(TrajectoryReader&&) noexcept = default;

void TrajectoryReader::Rewind() { impl_->Restart(); }

bool TrajectoryReader::Next(Trajectory* trajectory) {
  Impl& s = *impl_;
  while (true) {
    s.FillTo(s.next_core + s.core + s.margin);
    const long available = s.resampler.NumGridPoints();
    if (s.segment_ended && s.next_core >= available) {
      if (s.log_ended) return false;
      s.Clear();
      s.segment_ended = false;
      s.next_core = 0;
      ++s.segment;
      continue;
    }
    // A remainder shorter than half a core joins this one.
    long end = std::min(available, s.next_core + s.core);
    if (s.segment_ended && available - end < s.core / 2) end = available;
    if (end - s.next_core < 3 && s.next_core == 0) {  // nothing to use
      s.next_core = end;
      continue;
    }
    *trajectory = s.Make(s.next_core, end, available);
    s.next_core = end;
    s.DropBefore(std::max(0L, end - s.margin));
    return true;
  }
}

double TrajectoryReader::progress() const {
  const TimeRange& range = impl_->base.range;
  if (impl_->resampler.empty()) return impl_->log_ended ? 1 : 0;
  return (impl_->resampler.last_time() - range.begin) /
         (range.end - range.begin);
}

}  // namespace armcal
