#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/refine/nonlinear_calibration.h"
#include "model/dynamics/joint_controller.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"
#include "tools/command.h"

namespace armcal {

// --trust --length_trust --angle_trust
ArmTrust TrustFromFlags(const FlagValues& flags);

// What the flags ask of a robot for simulators.
struct Refinement {
  bool asked_for = false;  // by --estimate, --geometry or --poses
  std::string why_not;     // why it cannot be made; empty where it can
  NonlinearCalibrationOptions options;
  std::optional<PoseMeasurements> poses;
};

// Nothing where --estimate=linear. UsageError where what is asked for cannot
// be: flags that exclude each other.
std::optional<Refinement> RefinementFromFlags(
    const FlagValues& flags, const Robot& robot,
    const LinearCalibrationOptions& options);

// Whether --geometry asks for the arm's parameters to be refined, and which.
std::optional<RefineGeometry> RefineGeometryFromFlags(const FlagValues& flags);

// Adds the robot's files and the covariance of its parameters, and says what
// the files lose. `controller`: what moves it where commands are positions.
void AddRobotOutputs(const CommandInput& input,
                     const NonlinearCalibration& refined,
                     const std::optional<ControllerOptions>& controller,
                     nlohmann::json* json, CommandOutcome* outcome);

// Adds what a refined calibration says, its figures, robot and files; these to
// the first folder.
void AddRefinedOutputs(const CommandInput& input, const Robot& robot,
                       const NonlinearCalibration& refined,
                       nlohmann::json* json, CommandOutcome* outcome);

}  // namespace armcal
