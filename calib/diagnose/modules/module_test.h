#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"

namespace armcal {

// What modules compare themselves with: a joint motion that turns round a few
// times, its torques, and what EffectSteps says at every step.
struct ModuleTest {
  struct Step {
    Eigen::VectorXd q, qd, commanded, load;  // load: empty in the second half
    Eigen::VectorXd reading, torque, damping, undamped;
  };
  double dt, t;                  // s; t: at the begin
  Eigen::VectorXd warmth, load;  // at the begin, K; N m or N
  std::vector<Step> steps;
  // The largest of any joint and step, not 0.
  double LargestOf(Eigen::VectorXd Step::*values) const;
};

ModuleTest MakeModuleTest(const CorrectedRobot& robot);

}  // namespace armcal
