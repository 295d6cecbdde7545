#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/gap_baseline.h"
#include "calib/gap_candidates.h"
#include "model/effects/effect.h"
#include "model/simulated_robot.h"

namespace armcal {

// What a diagnosis found, as a robot that can be simulated.
struct CorrectedRobot {
  // The baseline's robot as fitted, its joint terms as laws: friction changes
  // sign as the regression says. On top of it the effects.
  SimulatedRobot plant;
  std::vector<GapCandidate> effects;  // that are in `plant`
  // By how much recorded torque is later than the motion, s: the timing that
  // was fitted. It is not in the plant, since only who replays a log knows
  // whether torque is given or recorded.
  double delay = 0;
  // What had to be made up to simulate it, a sentence each.
  std::vector<std::string> notes;
};

// The robot with the baseline at x (columns' units) and effects with all their
// parameters. A joint that effects make yield but that has no armature gets
// some, which `notes` tells.
CorrectedRobot MakeCorrectedRobot(const GapBaseline& baseline,
                                  const Eigen::VectorXd& x,
                                  const std::vector<GapCandidate>& effects,
                                  const MotionScale& scale);

}  // namespace armcal
