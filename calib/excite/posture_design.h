#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "calib/excite/design_kinds.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"
#include "problems/excitation_criterion.h"
#include "problems/motion_limits.h"
#include "problems/pose_problem.h"
#include "problems/workspace.h"

namespace armcal {

struct PostureOptions {
  int count = 20;
  PoseInstrument instrument = PoseInstrument::kTarget;
  ExcitationCriterion criterion = ExcitationCriterion::kD;
  Eigen::VectorXd lower, upper;  // of joint positions, rad or m
  Workspace workspace;
  PoseNoise noise;
  double prior_length = .01;  // m, how far lengths may be from the file's
  double prior_angle = .02;   // rad
  int candidates = 1000;      // random postures to start from
  std::uint64_t seed = 0;
};

// Postures chosen for a calibration of the arm's geometry.
struct PostureDesign {
  Eigen::MatrixXd q;  // postures x joints
  // Of the geometry that can be told, in m and rad.
  std::vector<std::string> names, units;
  Eigen::VectorXd stddev;                      // predicted
  Eigen::VectorXd random_stddev;               // with as many random ones
  double criterion = 0, random_criterion = 0;  // logarithms
};

// Chooses postures so that the geometry (all of ArmGeometry's parameters that
// such measurements tell, with instrument and target unknown) becomes as
// certain as possible: the best next one of random ones, then single joints of
// single postures are moved while that helps (Fedorov's exchanges, 1972).
// Throws std::invalid_argument where hardly any posture is clear of the
// workspace.
PostureDesign DesignPostures(const Robot& robot, const PostureOptions& options);

// The equations of each posture in units of the noise, rows x unknowns: what of
// the geometry, the instrument and the target such postures tell.
std::vector<Eigen::MatrixXd> PostureEquations(const Robot& robot,
                                              const PostureOptions& options,
                                              const Eigen::MatrixXd& q);

// What such postures tell.
double PostureCriterion(const Robot& robot, const PostureOptions& options,
                        const Eigen::MatrixXd& q);

}  // namespace armcal
