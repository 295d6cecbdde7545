#pragma once

#include <string>
#include <vector>

namespace armcal {

// PoseCalibration::held for people to read. A URDF has seven parameters a joint
// where four tell all (Denavit and Hartenberg 1955), so that thirty sentences
// may say the same: three or more that do are one, with a line for each link.
std::string HeldText(const std::vector<std::string>& sentences);

}  // namespace armcal
