#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "model/signals/trajectory.h"

namespace armcal {

// Samples of several logs in order of time, evenly thinned. What was low-passed
// at a bandwidth is taken at four times that rate, which loses nothing of it;
// of longer logs every second sample is left out until there are `most` at
// most. A Sample has members `log`, and `follows`: whether the one before it is
// the last of the same stretch, without a gap.
template <class Sample>
class ThinnedSamples {
 public:
  ThinnedSamples(double bandwidth_hz, long most)
      : bandwidth_hz_(bandwidth_hz), most_(most) {}

  // `make` makes the sample of a row of the trajectory.
  void Visit(int log, const Trajectory& t,
             const std::function<Sample(int row)>& make) {
    if (stride_ == 0) {
      stride_ = bandwidth_hz_ > 0
                    ? std::max(1L, std::lround(1 / (4 * bandwidth_hz_ * t.dt)))
                    : 1;
    }
    for (int k = t.core_begin; k < t.core_end; ++k) {
      const long index = t.first_index + k;
      if (index % stride_ == 0) Add({make(k), log, t.segment, index});
    }
  }

  std::vector<Sample> Samples() const {
    std::vector<Sample> samples;
    const Placed* last = nullptr;
    for (const Placed& placed : placed_) {
      samples.push_back(placed.sample);
      samples.back().log = placed.log;
      samples.back().follows = last != nullptr && last->log == placed.log &&
                               last->segment == placed.segment &&
                               placed.index - last->index == stride_;
      last = &placed;
    }
    return samples;
  }

 private:
  // A sample and where it stands on the time grid of its segment.
  struct Placed {
    Sample sample;
    int log;
    int segment;
    long index;
  };

  void Add(Placed placed) {
    placed_.push_back(std::move(placed));
    if (static_cast<long>(placed_.size()) <= most_) return;
    stride_ *= 2;
    const auto left_out = [this](const Placed& p) {
      return p.index % stride_ != 0;
    };
    placed_.erase(std::remove_if(placed_.begin(), placed_.end(), left_out),
                  placed_.end());
  }

  double bandwidth_hz_;
  long most_;
  long stride_ = 0;  // 0: no sample was seen yet
  std::vector<Placed> placed_;
};

}  // namespace armcal
