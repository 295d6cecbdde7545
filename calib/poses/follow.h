#pragma once

#include "model/log_files/pose_reader.h"

namespace armcal {

// rms of positions (of the first target, or of lengths) about their mean, m;
// tilts: rad; infinite of points that are touched, which have none.
double PoseExtent(const PoseMeasurements& measured);

// Whether a model that misses poses by so much (median, m) says anything about
// where they are: by a tenth of their extent at most. What an arm's geometry
// lacks is a hundredth of that; wrong joints, signs or units are most of it.
bool FollowsJoints(double median, double extent);

}  // namespace armcal
