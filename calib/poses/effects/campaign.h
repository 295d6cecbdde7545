#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// A number that something else has told; standard deviation 0: it has not.
struct Told {
  double value = 0, stddev = 0;
};

// What is known of a measured arm beside its geometry.
struct KnownArm {
  Robot robot;
  // Whether the robot's masses are those of the arm, with its tool.
  bool weighed = false;
  std::vector<double> gear_ratios = {};  // motor over joint; empty: not known
  // Of each joint, rad per N m, as logs of torque tell its elasticity; empty:
  // they do not.
  std::vector<Told> compliance = {};
};

// What effects of geometry are made from: an arm, and where its joints stood in
// each of the measured poses (rows), in the order of the file.
struct PoseCampaign {
  KnownArm arm;
  const Robot& robot() const { return arm.robot; }
  Eigen::MatrixXd recorded;  // rad or m, as the file has them
  // The same, corrected by effects found so far and by `zeros`, by which the
  // joints' zeros are off the file's (rad): what depends on where joints stand
  // is taken from the file's geometry there.
  Eigen::MatrixXd standing;
  Eigen::VectorXd zeros;
  Eigen::VectorXd travel;  // per joint, of `recorded`
  // Moments (m) about each joint of a unit weight at the tool, and of one that
  // is spread evenly over the origins of the further links.
  Eigen::MatrixXd tool_moment, link_moment;
  // Of an arm that was weighed: of its weight, N m. Else empty.
  Eigen::MatrixXd weight_moment;
  // What each pose is called for people, and the word before it: pose_label.h.
  std::vector<long> number;
  std::string word;
  int targets = 0;  // 0: whole poses or a wire
  bool whole_poses = false;
  bool wire = false;

  int size() const { return static_cast<int>(recorded.rows()); }
  int joints() const { return static_cast<int>(recorded.cols()); }
  // Whether a joint turns enough for what grows with its position to be seen.
  bool Moves(int joint) const;
  bool Turns(int joint) const;  // and is a rotational one
  // Whether rotations of a body that carries the targets are seen.
  bool ShowsRotation() const { return whole_poses || targets > 2; }
};

// `standing`: rows of joint positions without `zeros`; these empty: as in the
// file.
PoseCampaign MakeCampaign(const KnownArm& arm, const PoseMeasurements& measured,
                          const Eigen::MatrixXd& standing,
                          const Eigen::VectorXd& zeros = {});

}  // namespace armcal
