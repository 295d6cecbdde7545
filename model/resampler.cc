#include "model/resampler.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

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
  values_.clear();
  dropped_ = 0;
}

void Resampler::Append(const Log& block, int row) {
  if (times_.empty()) segment_begin_ = block.t[row];
  const std::array<const Eigen::MatrixXd*, kSignals> signals = {
      &block.q, &block.tau, &block.qd, &block.qdd, &block.temperature};
  Eigen::Index width = 0;
  for (int s = 0; s < kSignals; ++s) {
    widths_[s] = static_cast<int>(signals[s]->cols());
    width += widths_[s];
  }
  Eigen::RowVectorXd value(width);
  Eigen::Index at = 0;
  for (int s = 0; s < kSignals; ++s) {
    if (widths_[s] > 0) value.segment(at, widths_[s]) = signals[s]->row(row);
    at += widths_[s];
  }
  times_.push_back(block.t[row]);
  values_.push_back(std::move(value));
}

long Resampler::NumGridPoints() const {
  if (times_.empty()) return 0;
  if (uniform_) return dropped_ + static_cast<long>(times_.size());
  return static_cast<long>(
             std::floor((times_.back() - segment_begin_) / dt_ + 1e-9)) +
         1;
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
  values_.erase(values_.begin(), values_.begin() + count);
  dropped_ += count;
}

Eigen::RowVectorXd Resampler::Value(long index, size_t* hint) const {
  if (uniform_) return values_[static_cast<size_t>(index - dropped_)];
  const double t = segment_begin_ + static_cast<double>(index) * dt_;
  size_t right = *hint;  // first sample after t
  while (right < times_.size() && times_[right] <= t) ++right;
  *hint = right;
  const size_t size = times_.size();
  size_t first = std::min(right < 2 ? 0 : right - 2, size < 4 ? 0 : size - 4);
  int count = static_cast<int>(std::min<size_t>(4, size));
  double w[4];
  // Stamps nearly alike (a burst of late messages) would turn noise into
  // spikes; a straight line does not. Even steps reach 1.7, jittering ones 5.
  if (LagrangeWeights(&times_[first], count, t, w) > 10 && size >= 2) {
    first = std::clamp<size_t>(right, 1, size - 1) - 1;
    count = 2;
    LagrangeWeights(&times_[first], count, t, w);
  }
  Eigen::RowVectorXd value = w[0] * values_[first];
  for (int k = 1; k < count; ++k) value += w[k] * values_[first + k];
  return value;
}

void Resampler::Sample(long begin, long end, Log* out) const {
  CHECK_LE(end, NumGridPoints());
  const Eigen::Index rows = end - begin;
  const std::array<Eigen::MatrixXd*, kSignals> signals = {
      &out->q, &out->tau, &out->qd, &out->qdd, &out->temperature};
  for (int s = 0; s < kSignals; ++s) {
    signals[s]->resize(widths_[s] > 0 ? rows : 0, widths_[s]);
  }
  out->t.resize(rows);
  size_t hint = 0;
  for (Eigen::Index r = 0; r < rows; ++r) {
    const long index = begin + r;
    out->t[r] = segment_begin_ + static_cast<double>(index) * dt_;
    const Eigen::RowVectorXd value = Value(index, &hint);
    Eigen::Index at = 0;
    for (int s = 0; s < kSignals; ++s) {
      if (widths_[s] > 0) signals[s]->row(r) = value.segment(at, widths_[s]);
      at += widths_[s];
    }
  }
}

}  // namespace armcal
