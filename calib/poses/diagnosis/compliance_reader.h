#pragma once

#include <string>
#include <vector>

#include "calib/poses/effects/campaign.h"
#include "model/robot/robot.h"

namespace armcal {

// Each joint's compliance, rad per N m, by what a diagnosis of logs found of
// joints that give way: one over the stiffness; not told where it has none.
// `path` is its diagnosis.json or the folder of that. Throws InputError.
std::vector<Told> ReadCompliance(const std::string& path, const Robot& robot);

}  // namespace armcal
