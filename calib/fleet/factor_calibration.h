#pragma once

#include "calib/fleet/reduction.h"
#include "calib/linear/calibration.h"
#include "calib/linear/log_factors.h"
#include "model/robot/robot.h"

namespace armcal {

// The parameters of a reduction's model. Throws InputError, naming `file`,
// where they are not this robot's.
ModelParameters ParametersOf(const Robot& robot, const ReductionModel& model,
                             const std::string& file = "");

// The joints' factors of a log.
BlockTriangularFactor FactorOf(const ModelParameters& parameters,
                               const ReducedLog& log);

// Those of all logs.
LogFactors FactorsOf(const ModelParameters& parameters,
                     const Reduction& reduction);

// How much more a log's standard deviations are than those of its factor: its
// own measure, or where it was too short for one, the median of all that have
// one, or where none has, what rows that overlap `hops` times make of white
// noise at most.
Eigen::VectorXd Inflations(const Reduction& reduction);

// Weighted least squares on the rows of all logs with each joint's noise
// re-estimated, which is what CalibrateLinear does with a squared loss, from
// the factors alone: rows were weighed for good when their log was reduced.
// Standard deviations are those of independent rows times each log's inflation,
// and with three logs or more at least the scatter between logs. Nothing is
// known of samples: there are no residuals of torques and no noise of theirs.
LinearCalibration CalibrateFromFactors(const Robot& robot,
                                       const Reduction& reduction);

}  // namespace armcal
