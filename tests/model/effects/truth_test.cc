// Effects mean by their names, units and signs what truth.json means: hidden in
// a plant by laws of its own, they are found with their values by least squares
// on our columns.

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "tests/fixtures/effect_plant.h"
#include "tests/model/effects/hidden_truth.h"

namespace armcal::truth_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Search = EffectParameter::Search;

constexpr double kDuration = 8;  // s

// p with its linear parameters fitted to `measured`, the others as they are:
// Gauss and Newton's steps from 0, the first by the columns of a diagnosis.
VectorXd Fit(const EffectPlant& plant, const Effect& effect, int joint,
             const Log& log, const VectorXd& sizes) {
  constexpr int kSteps = 4;
  RecordedTorque recorded(plant.arm().robot, plant.arm().transitions,
                          EffectPlant::MotionOf(log));
  const auto change = [&](const VectorXd& p) -> VectorXd {
    return EffectPlant::Judged(plant.arm().Change(effect, joint, p, &recorded))
        .reshaped();
  };
  const VectorXd measured = plant.Measured(log).reshaped();
  std::vector<int> linear;
  VectorXd p = sizes;
  for (int k = 0; k < p.size(); ++k) {
    if (effect.parameters[k].search != Search::kLinear) continue;
    linear.push_back(k);
    p[k] = 0;
  }
  for (int step = 0; step < kSteps; ++step) {
    const VectorXd at = step == 0 ? VectorXd::Zero(measured.size()) : change(p);
    const double share = step == 0 ? 1 : 1e-2;
    MatrixXd columns(measured.size(), linear.size());
    for (size_t c = 0; c < linear.size(); ++c) {
      VectorXd next = p;
      next[linear[c]] += share * sizes[linear[c]];
      columns.col(c) = (change(next) - at) / share;
    }
    const VectorXd shares = columns.colPivHouseholderQr().solve(measured - at);
    for (size_t c = 0; c < linear.size(); ++c) {
      p[linear[c]] += shares[c] * sizes[linear[c]];
    }
  }
  return p;
}

struct Case {
  const char* effect;
  std::vector<const char*> estimates;
  // By which they are judged, of components of a vector; empty: by themselves.
  std::string scale = "";
  // What is found may be this many times the hidden law's own number, which is
  // the first of several.
  double times = 1;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.effect; }

class EffectTruth : public testing::TestWithParam<Case> {};

TEST_P(EffectTruth, IsWhatColumnsFind) {
  static const auto* const kPlant = new EffectPlant(kDuration);
  const Effect& effect = *FindEffect(GetParam().effect);
  const int joint = effect.scope == Effect::Scope::kRobot ? -1 : 1;
  SimulatedRobot robot = kPlant->Bare();
  const auto truth =
      HideEffect(effect.name, joint, kPlant->arm().robot, kDuration, &robot);
  VectorXd p = kPlant->arm().Sizes(effect, joint);
  for (int k = 0; k < p.size(); ++k) {
    const EffectParameter& parameter = effect.parameters[k];
    const auto known = truth.find(parameter.name);
    if (parameter.search != Search::kLinear && known != truth.end()) {
      p[k] = known->second;
    }
  }
  p = Fit(*kPlant, effect, joint, kPlant->Run(robot), p);
  const auto estimates = EstimatesOf(effect, kPlant->arm().Site(joint), p);
  for (const std::string name : GetParam().estimates) {
    double found = std::nan("");
    for (const EffectEstimate& estimate : estimates) {
      if (estimate.name == name) found = estimate.value;
    }
    const double expected = truth.at(name);
    const std::string& scale = GetParam().scale;
    const double tolerance =
        .1 * std::abs(scale.empty() ? expected : truth.at(scale));
    EXPECT_GE(found, expected - tolerance) << name;
    EXPECT_LE(found, GetParam().times * expected + tolerance) << name;
  }
}

// What flanks leave of the torque depends on the gap in jumps, which no step
// along a slope passes: of several gaps, between flanks as stiff as the hidden
// ones, the hidden one's is nearest. Hidden flanks have another damping, so
// that its share is not known: it is tried as the gap is.
TEST(EffectTruthOfBacklash, TheGapIsTheHiddenOnes) {
  const EffectPlant plant(12);
  const Effect& effect = *FindEffect("backlash");
  for (const int joint : {1, 2}) {
    SimulatedRobot robot = plant.Bare();
    const auto truth =
        HideEffect("backlash", joint, plant.arm().robot, 12, &robot);
    const Log log = plant.Run(robot);
    RecordedTorque recorded(plant.arm().robot, plant.arm().transitions,
                            EffectPlant::MotionOf(log));
    const MatrixXd measured = plant.Measured(log);
    const double load = plant.arm().scale.torque[joint];
    const double yields = load / truth.at("contact_stiffness");
    double best = 0, least = 1;
    for (const double times : {.8, .9, .95, 1., 1.05, 1.1, 1.2}) {
      const double gap = times * truth.at("backlash");
      for (const double damping_ratio : {.1, .2, .3, .5}) {
        const Eigen::Vector3d p(gap, yields / gap, damping_ratio);
        const MatrixXd change = EffectPlant::Judged(
            plant.arm().Change(effect, joint, p, &recorded));
        const double left = (measured - change).norm() / measured.norm();
        if (left < least) {
          least = left;
          best = times;
        }
      }
    }
    EXPECT_GE(best, .95) << joint;
    EXPECT_LE(best, 1.05) << joint;
    EXPECT_LT(least, .1) << joint;
  }
}

// Of friction that a joint's own heat takes away by Vogel's law, Reynolds'
// leaves .011 and .012 of the torque, at a time constant that is tried; one
// that falls evenly per kelvin .021 and .032, one that is heated by friction
// that does not fall .016 and .027. A third of the exponent is hidden of
// Coulomb friction.
TEST(EffectTruthOfThermalFriction, LittleIsLeft) {
  const EffectPlant plant(20);
  const Effect& effect = *FindEffect("thermal_friction");
  for (const int joint : {1, 2}) {
    SimulatedRobot robot = plant.Bare();
    const auto truth = HideEffect("thermal_friction", joint, plant.arm().robot,
                                  20, &robot, {.05, 25, .3});
    const Log log = plant.Run(robot);
    RecordedTorque recorded(plant.arm().robot, plant.arm().transitions,
                            EffectPlant::MotionOf(log));
    const MatrixXd measured = plant.Measured(log);
    double least = 1, ratio = 0;
    for (const double times : {.7, .85, 1., 1.2, 1.4}) {
      VectorXd p = plant.arm().Sizes(effect, joint);
      p[2] = times * truth.at("time_constant");
      p = Fit(plant, effect, joint, log, p);
      const MatrixXd change =
          EffectPlant::Judged(plant.arm().Change(effect, joint, p, &recorded));
      const double left = (measured - change).norm() / measured.norm();
      if (left >= least) continue;
      least = left;
      ratio = p[1] / p[0];
    }
    EXPECT_LT(least, .015) << joint;
    EXPECT_NEAR(ratio, 1. / 3, .1) << joint;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Effects, EffectTruth,
    testing::Values(
        Case{"viscous_friction", {"viscous"}},
        Case{"coulomb_friction", {"coulomb"}},
        Case{"viscous_friction_of_all_joints", {"share"}},
        Case{"torque_offset", {"offset"}}, Case{"presliding", {"coulomb"}},
        Case{"armature", {"armature"}},
        // A secant of a gear whose last stiffness is 1.5 times its first.
        Case{"elasticity", {"stiffness"}, "", 1.5},
        Case{"torque_ripple", {"ripple", "phase"}},
        Case{"torque_gain", {"gain"}},
        Case{"torque_gain_of_all_joints", {"gain"}},
        Case{"torque_deadband", {"deadband"}},
        Case{"torque_crosstalk", {"gain"}}, Case{"delay", {"delay"}},
        Case{"encoder_offset", {"offset"}}, Case{"link_length", {"length"}},
        Case{"base_tilt", {"tilt", "gravity_x", "gravity_y", "gravity_z"}},
        Case{"payload", {"mass", "com_x", "com_y", "com_z", "inertia"}},
        Case{"added_mass", {"mass", "hx", "hy", "hz"}},
        Case{"link_inertia", {"share", "mass"}},
        Case{"external_contact", {"force_x", "force_y", "force_z"}, "force"},
        Case{"time_base", {"rate"}}),
    [](const auto& info) { return info.param.effect; });

}  // namespace armcal::truth_test
