#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/changes/series.h"
#include "calib/diagnose/changes/series_fit.h"
#include "model/dynamics/joint_term.h"

namespace armcal {

// All joints' friction, as a direction of parameters over LogSeries::torque: a
// factor on it is a number times this. `level`: the parameters.
Eigen::VectorXd FrictionDirection(const LogSeries& series,
                                  const Eigen::VectorXd& level, JointTerm term);

// By what logs of a robot that does not change differ: every parameter by
// itself, and all joints' friction by a factor.
std::vector<ScatterComponent> MakeScatter(const LogSeries& series,
                                          const Eigen::VectorXd& level);

}  // namespace armcal
