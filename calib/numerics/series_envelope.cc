#include "calib/numerics/series_envelope.h"

#include <glog/logging.h>

#include <algorithm>

namespace armcal {
namespace {

void Merge(const SeriesEnvelope::Bin& next, SeriesEnvelope::Bin* bin) {
  bin->end = next.end;
  bin->low = bin->low.cwiseMin(next.low);
  bin->high = bin->high.cwiseMax(next.high);
  bin->samples += next.samples;
}

}  // namespace

SeriesEnvelope::SeriesEnvelope(int num_signals, int most_bins)
    : num_signals_(num_signals), most_bins_(most_bins) {
  CHECK_GE(most_bins, 2);
}

void SeriesEnvelope::Add(double t, const Eigen::VectorXd& values) {
  CHECK_EQ(values.size(), num_signals_);
  const Bin sample{t, t, values, values, follows_, 1};
  const bool joins =
      follows_ && !bins_.empty() && bins_.back().samples < samples_per_bin_;
  follows_ = true;
  if (joins) {
    Merge(sample, &bins_.back());
    return;
  }
  if (bins_.size() == most_bins_) Halve();
  bins_.push_back(sample);
}

void SeriesEnvelope::Break() { follows_ = false; }

// Across a gap only where there are too many of them.
void SeriesEnvelope::Halve() {
  const auto halved = [this](bool across_gaps) {
    std::vector<Bin> half;
    for (size_t k = 0; k < bins_.size(); ++k) {
      half.push_back(bins_[k]);
      if (k + 1 == bins_.size()) break;
      if (across_gaps || bins_[k + 1].follows) Merge(bins_[++k], &half.back());
    }
    return half;
  };
  std::vector<Bin> half = halved(false);
  if (half.size() > 3 * most_bins_ / 4) half = halved(true);
  bins_ = std::move(half);
  samples_per_bin_ *= 2;
}

}  // namespace armcal
