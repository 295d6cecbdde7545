#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/excite/design_target.h"
#include "calib/excite/excitation.h"
#include "calib/excite/posture_design.h"
#include "model/effects/effects.h"
#include "model/robot/robot.h"
#include "tools/command.h"

namespace armcal {

std::vector<FlagGroup> ExcitationFlagGroups();

// What the flags of armcal excite ask of a motion, but for the noise; where
// neither they nor the robot file say, `assumed` gets a sentence. Throws
// UsageError.
ExcitationOptions ExcitationOptionsFromFlags(const CommandInput& input,
                                             const Robot& robot,
                                             std::vector<std::string>* assumed);

// Nothing unless --static_poses asks for postures.
std::optional<PostureOptions> PostureOptionsFromFlags(
    const CommandInput& input, const Robot& robot,
    std::vector<std::string>* assumed);

DesignTarget TargetFromFlags(const FlagValues& flags);  // --target
// Of --separate; empty: none are asked for.
std::vector<const Effect*> SeparatedEffectsFromFlags(const FlagValues& flags);
// Shares of usual torques, per joint: --torque_noise.
Eigen::VectorXd NoiseSharesFromFlags(const FlagValues& flags, int num_joints);
// --given: logs, the path of a calibration, or nothing.
struct Given {
  std::vector<std::string> logs;
  std::string calibration;
  bool empty() const { return logs.empty() && calibration.empty(); }
};
Given GivenFromFlags(const FlagValues& flags);  // throws UsageError

}  // namespace armcal
