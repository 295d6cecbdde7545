#pragma once

#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_files/mjcf/mjcf_settings.h"
#include "model/robot_tree/robot_tree.h"

namespace armcal {

// A <joint> or <freejoint> of a body whose frame at q = 0 has the pose X_PB on
// its parent: type, axis, limits and dynamics; name, parent and child are the
// caller's. A joint turns the body about `pos`, by q - ref; both `pos` and
// `axis` are in a frame F of the body. What is wrong with the numbers of a
// joint is its `error`. Throws InputError for an unknown type.
TreeJoint ReadMjcfJoint(const MjcfElement& element,
                        const Eigen::Isometry3d& X_PB,
                        const Eigen::Isometry3d& X_BF, const std::string& name,
                        const MjcfSettings& settings);

// Whether the file limits by `range`: it says so by `limited`, or gives a range
// where the compiler takes that as a limit.
bool IsMjcfLimited(const MjcfElement& element, const char* limited,
                   const char* range, const MjcfSettings& settings);

}  // namespace armcal
