#pragma once

#include <Eigen/Core>

#include "calib/diagnose/data/rows.h"
#include "model/robot/robot.h"

namespace armcal {

// Whether a torque V on a joint that swings in time at a frequency (Hz) may be
// an error of the model: whether the joint's inertia, its gravity or all that
// the model has of its recorded torque has more at that frequency, so that an
// error by a part of that would look like V. As the motion has that line
// in other parts of the log, too, these confirm it. Inertia and gravity of a
// joint that swings freely cancel, and are asked one by one. A shaker's line is
// in what is recorded and in no part of the model, but for how it moves the
// arm.
//
// `swing`: V of all thinned samples, N m or N; `log`: whose it is, -1: of all.
// Samples where the joint rests are not asked.
bool IsLineOfMotion(const Robot& robot, const GapRows& rows, int joint, int log,
                    const Eigen::VectorXd& swing, double frequency);

}  // namespace armcal
