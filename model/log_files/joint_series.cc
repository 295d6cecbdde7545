#include "model/log_files/joint_series.h"

#include <algorithm>
#include <cmath>

#include "model/text/input_error.h"

namespace armcal {

void DropEmptyChannels(JointSeries* series) {
  const size_t width = series->channels.size();
  std::vector<size_t> kept;
  for (size_t c = 0; c < width; ++c) {
    for (long k = 0; k < series->size(); ++k) {
      if (std::isnan(series->value(k, c))) continue;
      kept.push_back(c);
      break;
    }
  }
  if (kept.size() == width) return;
  size_t to = 0;
  for (long k = 0; k < series->size(); ++k) {
    for (const size_t c : kept) series->values[to++] = series->value(k, c);
  }
  series->values.resize(to);
  std::vector<JointSeries::Channel> channels;
  for (const size_t c : kept) channels.push_back(series->channels[c]);
  series->channels = channels;
}

JointSeriesAt::JointSeriesAt(const std::string& path, const JointSeries& series)
    : series_(series) {
  constexpr double kLongest = 3;  // mean steps
  const auto& t = series.times;
  for (size_t k = 1; k < t.size(); ++k) {
    if (t[k] >= t[k - 1]) continue;
    throw InputError(
        path, "topic " + series.topic + ", message " + std::to_string(k + 1),
        std::to_string(t[k]) + " ns",
        "time runs backwards, the message before has " +
            std::to_string(t[k - 1]) + " ns");
  }
  if (t.size() < 2) return;
  longest_step_ =
      kLongest * static_cast<double>(t.back() - t.front()) / (t.size() - 1.0);
}

bool JointSeriesAt::Find(std::int64_t time) {
  const auto& t = series_.times;
  const auto after = std::upper_bound(t.begin(), t.end(), time);
  if (after == t.begin()) return false;
  before_ = after - t.begin() - 1;
  share_ = 0;
  if (t[before_] == time) return true;
  if (after == t.end()) return false;
  const auto step = static_cast<double>(*after - t[before_]);
  share_ = static_cast<double>(time - t[before_]) / step;
  return step <= longest_step_;
}

double JointSeriesAt::value(size_t channel) const {
  const double a = series_.value(before_, channel);
  if (share_ == 0) return a;
  return a + share_ * (series_.value(before_ + 1, channel) - a);
}

}  // namespace armcal
