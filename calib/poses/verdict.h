#pragma once

#include <string>
#include <vector>

#include "calib/poses/calibration.h"
#include "model/robot/robot.h"

namespace armcal {

// Sentences that say why a fit of poses does not give what was asked for: it
// has no solution, joint positions are coupled, a joint between others never
// moves or moves only in outliers, the poses do not follow the joints, lengths
// are farther from the file's than its prior allows, too many poses are
// outliers, others are predicted clearly worse than by the file, or far more is
// left than the instrument's uncertainty. None where all is well.
std::vector<std::string> Shortcomings(const Robot& robot,
                                      const PoseCalibration& result);

// Whether the refined geometry predicts poses that it has not seen worse than
// the file's geometry does.
bool IsWorseThanFile(const PoseCalibration& result);

// Sentences that are no reason to fail: joints at the base that never move are
// held, what is left depends on when it was measured, or the refined geometry
// is worse than the file's by no more than chance.
std::vector<std::string> PoseNotes(const Robot& robot,
                                   const PoseCalibration& result);

}  // namespace armcal
