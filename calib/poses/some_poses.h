#pragma once

#include "model/log_files/pose_reader.h"

namespace armcal {

// Every n-th pose, so that there are not more than `most`.
PoseMeasurements SomePoses(const PoseMeasurements& measured, int most);

}  // namespace armcal
