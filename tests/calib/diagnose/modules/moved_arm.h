#pragma once

#include <random>
#include <string>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"
#include "model/effects/effects.h"
#include "tests/fixtures/corrected_arm.h"

namespace armcal {

// CorrectedArm with effects of random parameters, as a diagnosis would have
// them.
struct MovedArm {
  MovedArm() {
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(3);
    arm.scale.torque = 20 * one;
    arm.scale.load = 15 * one;
    arm.scale.speed = arm.scale.top_speed = .6 * one;
    arm.scale.acceleration = 3 * one;
    arm.scale.begin = 2;
    arm.scale.end = 12;
  }

  EffectSite Site(int joint) const { return {&arm.file, joint, &arm.scale}; }

  bool Fits(const Effect& effect, int joint) const {
    return !effect.unfit || effect.unfit(Site(joint)).empty();
  }

  // Of half to one and a half of usual sizes; shapes of the grids.
  GapCandidate Drawn(const Effect& effect, int joint) {
    GapCandidate found;
    found.effect = &effect;
    found.joint = joint;
    found.p.resize(effect.parameters.size());
    for (size_t k = 0; k < effect.parameters.size(); ++k) {
      const EffectParameter& parameter = effect.parameters[k];
      double& p = found.p[k];
      p = parameter.size(Site(joint)) * (.5 + Uniform());
      if (!parameter.grid) continue;
      const std::vector<double> grid = parameter.grid(Site(joint));
      p = grid[random() % grid.size()];
    }
    return found;
  }

  // With friction of every kind on each joint, and an offset.
  CorrectedRobot With(const std::vector<GapCandidate>& effects,
                      double delay = 0) const {
    const GapBaseline baseline = arm.Baseline();
    CorrectedRobot robot = MakeCorrectedRobot(
        baseline, arm.TrueValues(baseline, delay), effects, arm.scale);
    for (int j = 0; j < 3; ++j) {
      robot.plant.robot.links[j].joint.offset = .3 * (j + 1);
      robot.coulomb[j].push_back(
          {1.5, {CoulombTransition::Law::kDisplacement, .004 * (j + 1)}});
    }
    // As if the log had said so.
    for (CarriedEffect& effect : robot.effects) {
      const auto size = effect.found.effect->stand_ins.size();
      effect.share = Eigen::VectorXd::LinSpaced(size, .3, -.2);
    }
    return robot;
  }

  double Uniform() { return std::uniform_real_distribution<>()(random); }

  CorrectedArm arm;
  std::mt19937_64 random{7};
};

}  // namespace armcal
