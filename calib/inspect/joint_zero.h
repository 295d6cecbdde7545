#pragma once

#include <vector>

#include "calib/logs/inspection_finding.h"
#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// Whether a joint of the robot file turns the other way than the arm's, or has
// its zero a quarter or half of a turn elsewhere, or both: a frame that was
// turned when the file was written. A fit of inertias does not see that, as it
// turns the centres of mass along and takes an offset for the rest; so the
// file's own bodies are asked (docs/inspect.md, How it tells).
//
// Each of these hypotheses, and the file as it is, says up to a factor what the
// links need of each torque. That, the joint's friction, armature and an offset
// are fitted, so that all have as many parameters, and BIC compares them by
// what they leave: m / 2 ln(squares) summed over the joints, m being how many
// independent samples the autocorrelation of what is left comes to. What is
// better is told as one doubt, the best first: several may be alike, and the
// centres of mass that the file has for the links beyond may be what is wrong.
// `samples` are read as they are logged.
std::vector<InspectionFinding> DoubtJointZeros(const Robot& robot,
                                               const WiringSamples& samples);

}  // namespace armcal
