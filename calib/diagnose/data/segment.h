#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "model/log_files/time_base.h"
#include "model/signals/motion.h"

namespace armcal {

// What is shorter is left out, s.
inline constexpr double kShortestSegment = 2;

// A stretch of a log without gaps, in memory as a whole: what a diagnosis
// works on, since effects with a memory (heat, bristles) run through all of it.
struct GapSegment {
  int log = 0;
  Motion motion;        // low-passed at the bandwidth
  Eigen::MatrixXd tau;  // N m or N, samples x n
  // Where a joint stands still (model/signals/standstill.h) its friction is an
  // interval, not a value; samples x n.
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> still;
  // Where a joint that rested has not yet moved by its bearings' presliding
  // displacement (standstill.h): its friction is still on the way from that
  // interval to the value of sliding; samples x n, empty: nowhere.
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> breaks_away;

  // Per joint, samples of its position that were left out as spikes
  // (position_spikes.h); empty: none were looked for.
  Eigen::Array<long, 1, Eigen::Dynamic> position_spikes;

  bool reconstructed_torque = false;  // of commands, by the law of the drives
  bool torque_drifts = false;         // torque_drift.h
  // A draw of the positions' noise and of what it makes of such torques,
  // samples x n; empty: none.
  Eigen::MatrixXd position_noise, torque_noise;
  // Where rows were lost, or a loop its stability (torque_bursts.h): neither
  // the motion nor a torque reconstructed from it is as good there. Of recorded
  // torques, whose noise is larger, none.
  std::vector<TimeRange> lost;

  int size() const { return motion.size(); }
  bool BreaksAway(int sample, int joint) const {
    return breaks_away.size() > 0 && breaks_away(sample, joint);
  }
  bool IsLost(double t) const {
    return std::any_of(lost.begin(), lost.end(), [t](const TimeRange& range) {
      return range.Contains(t);
    });
  }
};

// rms of the torque, n entries, N m or N, where rows are not lost;
// `of_reconstructed_torques`: with recorded ones as 0.
Eigen::VectorXd UsualTorque(const std::vector<GapSegment>& segments,
                            bool of_reconstructed_torques = false);

// Whether their torques, if any, were reconstructed from commands, with a draw
// of noise.
bool HaveNoiseOfPositions(const std::vector<GapSegment>& segments);

}  // namespace armcal
