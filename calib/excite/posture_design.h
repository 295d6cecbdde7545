#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/excite/posture_options.h"
#include "model/robot/robot.h"

namespace armcal {

// Postures chosen for a calibration of the arm's geometry, or to tell effects
// beside it apart.
struct PostureDesign {
  Eigen::MatrixXd q;  // postures x joints
  // Of the geometry that can be told, in m and rad, or of effects' amounts.
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
// workspace; OptionError as PostureModel does.
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
