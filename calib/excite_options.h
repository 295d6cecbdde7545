#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calib/excite/design_kinds.h"
#include "calib/log_input.h"
#include "calib/refine/arm_trust.h"
#include "calib/robot_source.h"
#include "model/log_files/log_reader_options.h"
#include "model/text/progress.h"
#include "problems/excitation_criterion.h"
#include "problems/workspace_options.h"

namespace armcal {

// What a motion must stay within, one number or one per joint; empty: the
// robot's limits, or usual ones where it has none.
struct ExcitationLimits {
  Eigen::VectorXd lower, upper;  // rad or m
  Eigen::VectorXd velocity;      // rad/s or m/s
  Eigen::VectorXd acceleration;  // rad/s^2 or m/s^2; else 3 times the velocity
  Eigen::VectorXd effort;        // N m or N
  double use = .95;              // share of all that the motion may use
};

// Postures for a calibration of the geometry, instead of a motion.
struct StaticPoses {
  int count = 20;
  PoseInstrument instrument = PoseInstrument::kTarget;
  double position_noise = 1e-4;  // m, standard deviation
  double rotation_noise = 1e-4;  // rad
};

struct ExciteOptions {
  DesignTarget target = DesignTarget::kModel;
  // Names of effects that the motion is to tell apart, instead of a target.
  std::vector<std::string> separate;
  std::optional<StaticPoses> poses;
  double duration_s = 20;  // .5 to 1000
  int periods = 1;         // equal ones that the duration holds, 1 to 100
  int harmonics = 0;       // 2 to 100; 0: up to .5 Hz, 1 Hz with `separate`
  double rate_hz = 250;    // of the log that will be recorded, 1 to 1e5
  ExcitationCriterion criterion = ExcitationCriterion::kD;
  ExcitationLimits limits;
  WorkspaceOptions workspace;
  // Noise of torque samples as shares of usual torques, one or one per joint.
  Eigen::VectorXd torque_noise = Eigen::VectorXd::Constant(1, .01);
  ArmTrust trust;  // in the robot file, with the targets but kModel
  // Logs, or the path of a calibration.json, that exist: the motion adds what
  // they do not tell.
  LogInput given;
  std::string given_calibration;
  LogReaderOptions reading;            // of the logs' torques
  std::optional<double> bandwidth_hz;  // of the logs; as for a calibration
  std::uint64_t seed = 0;
  RobotSource source;  // of the robot
  Progress progress;
};

}  // namespace armcal
