#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/log_files/log.h"

namespace armcal {

// A sliding window over the samples of one segment of a log, and its values on
// a uniform grid t = first time of the segment + index * dt.
class Resampler {
 public:
  Resampler(double dt, bool uniform) : dt_(dt), uniform_(uniform) {}

  void Clear();
  bool empty() const { return times_.empty(); }
  double first_time() const { return segment_begin_; }
  double last_time() const { return times_.back(); }
  void Append(const Log& block, int row, int count = 1);
  // Puts spikes (position_spikes.h) of the positions that it holds on the line
  // between the samples around them, and every signal where two joints or more
  // have one; of how many, per joint. `ends`: the last sample is the segment's.
  Eigen::Array<long, 1, Eigen::Dynamic> RemovePositionSpikes(bool ends = true);
  // Number of grid points up to the last sample.
  long NumGridPoints() const;
  // With `count` samples more, the last of them at time t; not while empty.
  long NumGridPointsWith(double t, long count) const;
  // Forgets samples that no grid point from `index` on needs.
  void DropBefore(long index);
  // Grid points [begin, end): positions etc. into the matrices of *out (t as
  // well). Exact samples where the time base is uniform, else cubic through
  // the four nearest samples, or linear where their stamps nearly coincide.
  void Sample(long begin, long end, Log* out) const;

 private:
  // q, tau, qd, qdd, temperature, wrench, current.
  static constexpr int kSignals = 7;
  // The samples between which a grid point lies, and their weights.
  struct Neighbours {
    size_t first;
    int count;
    double weight[4];
  };
  Neighbours Find(long index, size_t* hint) const;

  double dt_;
  bool uniform_;
  double segment_begin_ = 0;
  long dropped_ = 0;  // samples of the segment already forgotten
  std::vector<double> times_;
  std::vector<std::vector<double>> columns_;  // signals side by side
  std::array<int, kSignals> widths_{};
};

}  // namespace armcal
