#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/numerics/triangular_factor.h"
#include "model/dynamics/joint_term.h"
#include "model/robot/robot.h"
#include "problems/identification_rows.h"
#include "problems/robust_loss.h"

namespace armcal {

// What logs have in common whose equations can be put together: the robot, the
// parameters and the way to equations.
struct ReductionModel {
  std::string robot;         // its name
  std::string robot_sha256;  // of its file
  Eigen::Vector3d gravity;   // in the base frame, m/s^2
  std::vector<std::string> parameters, units;
  GeometryKnowledge geometry = GeometryKnowledge::kKnown;
  std::vector<JointTerm> joint_terms;
  std::vector<CoulombTransition> transitions;  // per joint, or none
  RowOptions rows;                             // without intervals
  RobustLoss loss = RobustLoss::kHuber;

  // Those of a calibration that makes the same equations of any log.
  LinearCalibrationOptions Options() const;
};

// A log, reduced to what a calibration needs of it.
struct ReducedLog {
  std::string file;                    // its name without the folder
  std::string sha256;                  // of its bytes
  std::string torque;                  // LogSet::torque_source()
  double torque_constants_stddev = 0;  // as LogSet has it
  std::string unit;            // which robot of its kind; empty: not said
  std::optional<double> time;  // when it was recorded, s since 1970, UTC
  long samples = 0;
  TimeRange range;  // s since its first row
  bool resampled = false;
  int gaps = 0;
  double motion_hz = 0;
  Eigen::ArrayXd mean_square_speed;  // per joint, (rad/s)^2 or (m/s)^2
  Eigen::VectorXd travel;            // per joint, rad or m
  // The log's own standard deviations over those of its factor, whose rows pass
  // for independent; nothing where it was too short to tell.
  std::optional<double> inflation;
  std::vector<TriangularFactor> factors;  // per joint
};

// Reduced logs of one model, in the order of (sha256, begin): whatever is
// added up over them is added in this order, and has the same bits however they
// were named, put together before, or by how many processes reduced.
struct Reduction {
  ReductionModel model;
  std::vector<ReducedLog> logs;
};

}  // namespace armcal
