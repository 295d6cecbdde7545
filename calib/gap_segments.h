#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "calib/log_set.h"
#include "model/motion.h"

namespace armcal {

// A stretch of a log without gaps, in memory as a whole: what a diagnosis
// works on, since effects with a memory (heat, bristles) run through all of it.
struct GapSegment {
  int log = 0;
  Motion motion;        // low-passed at the bandwidth
  Eigen::MatrixXd tau;  // N m or N, samples x n
  // Where a joint stands still (model/standstill.h) its friction is an
  // interval, not a value; samples x n.
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> still;

  bool made_torque = false;    // of commands, by the law of the drives
  bool torque_drifts = false;  // torque_drift.h
  // A draw of the positions' noise and of what it makes of such torques,
  // samples x n; empty: none.
  Eigen::MatrixXd position_noise, torque_noise;
  // Where rows were lost, or a loop its stability (torque_bursts.h): neither
  // the motion nor a torque made of it is as good there. Of recorded torques,
  // whose noise is larger, none.
  std::vector<TimeRange> lost;

  int size() const { return motion.size(); }
  bool IsLost(double t) const {
    return std::any_of(lost.begin(), lost.end(), [t](const TimeRange& range) {
      return range.Contains(t);
    });
  }
};

// The segments of the logs, in order; those shorter than 2 s are left out.
// Motion is low-passed at five times the bandwidth of the torque residual:
// what is computed from it passes that filter again, as the torque does, and
// must not have been bent below it.
std::vector<GapSegment> ReadSegments(double bandwidth_hz,
                                     const Progress& progress, LogSet* logs);

// rms of the torque, n entries, N m or N, where rows are not lost;
// `of_made_torques`: with recorded ones as 0.
Eigen::VectorXd UsualTorque(const std::vector<GapSegment>& segments,
                            bool of_made_torques = false);

// Whether their torques, if any, were made of commands, with a draw of noise.
bool HaveNoiseOfPositions(const std::vector<GapSegment>& segments);

// Noise of the recorded positions (position_noise.h), n entries, and the rate
// they were recorded at.
struct RecordedPositions {
  Eigen::VectorXd noise;  // rad or m
  double rate_hz = 0;
};
RecordedPositions AuditPositions(const Progress& progress, LogSet* logs);

// Of the motion of segments, Hz.
double MotionBandwidth(double bandwidth_hz);

}  // namespace armcal
