#pragma once

#include <vector>

#include "calib/diagnose/data/baseline_column.h"
#include "calib/diagnose/data/column_prior.h"
#include "calib/refine/parameter_posterior.h"
#include "model/robot/robot.h"

namespace armcal {

// What a calibration's posterior says of the columns of its robot, in their
// units, its deviations times `deviations`. `another_day`: the logs that are
// fitted next are of another day, whose friction may differ from the
// calibration's.
ColumnPrior CalibratedPrior(const ParameterPosterior& posterior,
                            double deviations, const Robot& robot,
                            const std::vector<BaselineColumn>& columns,
                            bool another_day);

}  // namespace armcal
