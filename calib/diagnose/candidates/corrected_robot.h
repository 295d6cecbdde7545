#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/baseline.h"
#include "calib/logs/joint_term_laws.h"
#include "model/dynamics/simulated_robot.h"
#include "model/effects/effect.h"

namespace armcal {

constexpr double kLeastDelay = 1e-4;  // s; a shorter one nobody would miss

// An effect that a robot was given.
struct CarriedEffect {
  GapCandidate found;
  std::vector<EffectEstimate> estimates;  // what it says of itself
  EffectNumbers numbers;                  // of its law, for modules
  bool in_robot = false;  // all of it: a payload, a link's length, an armature
  bool in_delay = false;  // it is part of CorrectedRobot::delay
  // In a delay by which torque acts after it was asked for, which simulators
  // know, and not one by which logs hold it too late.
  bool acts_late = false;
  // Of each of its stand_ins, SI units: SetLawShares. Empty: not known, or 0.
  Eigen::VectorXd share;
};

// What a diagnosis found, as a robot that can be simulated.
struct CorrectedRobot {
  // The baseline's robot as fitted, its joint terms as laws: friction changes
  // sign as the regression says. On top of it the effects, whose joint laws
  // come first.
  SimulatedRobot plant;
  int num_effect_laws = 0;
  std::vector<std::vector<CoulombPart>> coulomb;  // per joint, in `plant`
  Eigen::VectorXd width;  // of effects' own friction: MotionScale's
  MotionScale scale;      // of the motion that it was fitted to
  std::vector<CarriedEffect> effects;
  // By how much recorded torque is later than the motion, s: the timing that
  // was fitted. It is not in the plant, since only who replays a log knows
  // whether torque is given or recorded.
  double delay = 0;
  void AddDelay(double more);
  // Whether files and reports are to have it: an effect says so, or it is
  // farther from 0 than timing may be that no effect was found in.
  bool has_delay() const;
  bool acts_late() const { return delay < 0 && has_delay(); }
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
