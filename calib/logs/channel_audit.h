#pragma once

#include <optional>
#include <vector>

#include "calib/logs/inspection_finding.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// What the stamps of a log are like.
struct StampFigures {
  double step = 0;        // s, the shortest usual one
  double mean_step = 0;   // s
  double lost_share = 0;  // of samples, where steps are multiples of `step`
  long duplicates = 0;
  double longest_gap = 0;  // s
  // Steps over three usual ones and over kHole: they split the log.
  long holes = 0;
  double hole_time = 0;  // s, of all of them
  // By which stamps have to be multiplied to be seconds: 1, or 1e-3, 1e-6, 1e-9
  // where no arm is logged that slowly.
  double unit = 1;
};
StampFigures AuditStamps(const Log& log);

// A joint's recorded velocity beside the slope of its position.
struct VelocityFit {
  double factor = 0;  // times the slope
  double alike = 0;   // correlation

  bool right() const { return alike > .8 && factor > .7 && factor < 1.4; }
};
// Nothing of a joint that hardly moves, or without a velocity.
std::optional<VelocityFit> FitVelocity(const Log& log, int joint);
// Where the velocities of two joints and more, and of all that move, are wrong
// by one factor, that is the time or the velocities' unit: one finding instead
// of one per joint.
void SayOfAllVelocities(const Robot& robot, const Log& log,
                        std::vector<InspectionFinding>* findings);

// Findings from single columns: time in another unit, lost samples, a column
// that stands still while its joint moves, one at a limit, one of few values,
// recorded velocities that are not the positions'. The log has q, tau, qd and
// qref or not, and its time in s.
std::vector<InspectionFinding> AuditChannels(const Robot& robot, const Log& log,
                                             const StampFigures& stamps);

}  // namespace armcal
