#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/diagnosis.h"

namespace armcal {

// What to do after a diagnosis, sentences without their ends, the first one
// first: the experiments that would settle what is not certain, what tells
// more where no effect is named, and how the robot that was found gets into a
// simulator. Few; empty where the data cannot carry a diagnosis, whose findings
// say what mends them.
std::vector<std::string> NextSteps(const GapDiagnosis& diagnosis);

}  // namespace armcal
