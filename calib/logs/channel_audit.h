#pragma once

#include <optional>
#include <vector>

#include "calib/logs/inspection_finding.h"
#include "calib/logs/stamp_audit.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

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
// `torque_units`: N m or N of a unit of what is logged, per joint, where that
// is currents or voltages.
std::vector<InspectionFinding> AuditChannels(
    const Robot& robot, const Log& log, const StampFigures& stamps,
    const std::vector<double>& torque_units = {});

}  // namespace armcal
