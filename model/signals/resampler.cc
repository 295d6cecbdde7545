#include "model/signals/resampler.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/signals/position_spikes.h"

namespace armcal {
namespace {

// Lagrange weights at t of the nodes x[0..count); returns the sum of their
// sizes, by which errors of the samples may grow.
double LagrangeWeights(const double* x, int count, double t, double* w) {
  double growth = 0;
  for (int i = 0; i < count; ++i) {
    w[i] = 1;
    for (int j = 0; j < count; ++j) {
      if (j != i) w[i] *= (t - x[j]) / (x[i] - x[j]);
    }
    growth += std::abs(w[i]);
  }
  return growth;
}

}  // namespace

void Resampler::Clear() {
  times_.clear();
  for (std::vector<double>& column : columns_) column.clear();
  dropped_ = 0;
}

void Resampler::Append(const Log& block, int row, int count) {
  if (times_.empty()) segment_begin_ = block.t[row];
  const double* const t = block.t.data() + row;
  times_.insert(times_.end(), t, t + count);
  const std::array<const Eigen::MatrixXd*, kSignals> signals = {
      &block.q,           &block.tau,    &block.qd,     &block.qdd,
      &block.temperature, &block.wrench, &block.current};
  size_t at = 0;
  for (int s = 0; s < kSignals; ++s) {
    widths_[s] = static_cast<int>(signals[s]->cols());
    if (columns_.size() < at + widths_[s]) columns_.resize(at + widths_[s]);
    for (int c = 0; c < widths_[s]; ++c, ++at) {
      const double* const x = signals[s]->col(c).data() + row;
      columns_[at].insert(columns_[at].end(), x, x + count);
    }
  }
}

Eigen::Array<long, 1, Eigen::Dynamic> Resampler::RemovePositionSpikes(
    bool ends) {
  using Samples = Eigen::Map<Eigen::VectorXd>;
  const auto count = static_cast<Eigen::Index>(times_.size());
  const Samples t(times_.data(), count);
  const auto bridge = [&](const PositionSpike& spike, int column) {
    Bridge(spike, t, Samples(columns_[column].data(), count));
  };
  Eigen::Array<long, 1, Eigen::Dynamic> removed(widths_[0]);
  std::vector<std::vector<PositionSpike>> of_joints;
  for (int j = 0; j < widths_[0]; ++j) {
    of_joints.push_back(FindSpikes(t, Samples(columns_[j].data(), count),
                                   {dropped_ == 0, ends}));
    removed[j] = 0;
    for (const PositionSpike& spike : of_joints.back()) {
      bridge(spike, j);
      removed[j] += spike.end - spike.begin;
    }
  }
  for (const PositionSpike& row : WrongRows(of_joints)) {
    for (int c = 0; c < static_cast<int>(columns_.size()); ++c) {
      bridge(row, c);
    }
  }
  return removed;
}

long Resampler::NumGridPoints() const {
  return times_.empty() ? 0 : NumGridPointsWith(times_.back(), 0);
}

long Resampler::NumGridPointsWith(double t, long count) const {
  if (uniform_) return dropped_ + static_cast<long>(times_.size()) + count;
  return static_cast<long>(std::floor((t - segment_begin_) / dt_ + 1e-9)) + 1;
}

void Resampler::DropBefore(long index) {
  long needed = index - dropped_;  // stamps may drift against a uniform grid
  if (!uniform_) {
    const double t = segment_begin_ + static_cast<double>(index) * dt_;
    needed = std::lower_bound(times_.begin(), times_.end(), t - dt_ / 2) -
             times_.begin();
  }
  const long keep = 4;  // neighbours of the cubic
  const long count =
      std::clamp(needed - keep, 0L, static_cast<long>(times_.size()));
  times_.erase(times_.begin(), times_.begin() + count);
  for (std::vector<double>& column : columns_) {
    column.erase(column.begin(), column.begin() + count);
  }
  dropped_ += count;
}

Resampler::Neighbours Resampler::Find(long index, size_t* hint) const {
  const double t = segment_begin_ + static_cast<double>(index) * dt_;
  size_t right = *hint;  // first sample after t
  while (right < times_.size() && times_[right] <= t) ++right;
  *hint = right;
  const size_t size = times_.size();
  Neighbours n;
  n.first = std::min(right < 2 ? 0 : right - 2, size < 4 ? 0 : size - 4);
  n.count = static_cast<int>(std::min<size_t>(4, size));
  // Stamps nearly alike (a burst of late messages) would turn noise into
  // spikes; a straight line does not. Even steps reach 1.7, jittering ones 5.
  if (LagrangeWeights(&times_[n.first], n.count, t, n.weight) > 10 &&
      size >= 2) {
    n.first = std::clamp<size_t>(right, 1, size - 1) - 1;
    n.count = 2;
    LagrangeWeights(&times_[n.first], n.count, t, n.weight);
  }
  return n;
}

void Resampler::Sample(long begin, long end, Log* out) const {
  CHECK_LE(end, NumGridPoints());
  const Eigen::Index rows = end - begin;
  out->t.resize(rows);
  std::vector<Neighbours> neighbours;
  size_t hint = 0;
  for (Eigen::Index r = 0; r < rows; ++r) {
    out->t[r] = segment_begin_ + static_cast<double>(begin + r) * dt_;
    if (!uniform_) neighbours.push_back(Find(begin + r, &hint));
  }
  const auto value = [](const double* x, const Neighbours& n) {
    double sum = n.weight[0] * x[n.first];
    for (int k = 1; k < n.count; ++k) sum += n.weight[k] * x[n.first + k];
    return sum;
  };
  const std::array<Eigen::MatrixXd*, kSignals> signals = {
      &out->q,           &out->tau,    &out->qd,     &out->qdd,
      &out->temperature, &out->wrench, &out->current};
  size_t at = 0;
  for (int s = 0; s < kSignals; ++s) {
    signals[s]->resize(widths_[s] > 0 ? rows : 0, widths_[s]);
    for (int c = 0; c < widths_[s]; ++c, ++at) {
      const double* const from = columns_[at].data();
      double* const to = signals[s]->col(c).data();
      if (uniform_) std::copy_n(from + (begin - dropped_), rows, to);
      for (size_t r = 0; r < neighbours.size(); ++r) {
        to[r] = value(from, neighbours[r]);
      }
    }
  }
}

}  // namespace armcal
