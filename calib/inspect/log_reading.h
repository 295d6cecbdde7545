#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/inspect/reading_change.h"
#include "calib/logs/uniform_series.h"
#include "model/robot/robot.h"

namespace armcal {

// What is known of a log beside its motion and torques.
struct ReadingHints {
  std::vector<bool> tells;  // whose torque tells a sign; empty: all
  // Accelerations by a time that was rebuilt are rough, and a load that turns
  // explains some of that.
  bool asks_gravity = true;
  PositionUnitHints units;
};

struct ReadingFinding {
  LogReading reading;
  std::vector<ReadingChange> changes;  // in the order they were found
  double residual_percent_as_is = 0, residual_percent = 0;
};

// Reads a log as its torques fit the robot best: up to four changes, one after
// the other, each of which has to explain much more than chance and a model's
// own errors do: `kLeastReadingGain` nats of some hundred samples, and, of
// torques that the fit has not seen, what IsClearlyBetter and IsBetterForAll
// say. Of signs and order nothing is asked of joints that hardly move, nor of
// those whose torque tells nothing; of gravity nothing where one of several
// joints moves. A unit of positions that something else speaks for comes first,
// and has to fit no worse.
ReadingFinding FindReading(const Robot& robot, const UniformSeries& series,
                           const ReadingHints& hints = {});

}  // namespace armcal
