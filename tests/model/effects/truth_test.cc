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

// p with its linear parameters fitted to `measured`, the others as they are.
VectorXd Fit(const EffectPlant& plant, const Effect& effect, int joint,
             const Log& log, VectorXd p) {
  RecordedTorque recorded(plant.arm().robot, plant.arm().transitions,
                          EffectPlant::MotionOf(log));
  const MatrixXd measured = plant.Measured(log);
  MatrixXd columns(measured.size(), 0);
  for (int k = 0; k < p.size(); ++k) {
    if (effect.parameters[k].search != Search::kLinear) continue;
    VectorXd one = p;
    for (int i = 0; i < p.size(); ++i) {
      if (i != k && effect.parameters[i].search == Search::kLinear) one[i] = 0;
    }
    const MatrixXd change =
        EffectPlant::Judged(plant.arm().Change(effect, joint, one, &recorded));
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.rightCols(1) = change.reshaped();
  }
  const VectorXd shares =
      columns.colPivHouseholderQr().solve(VectorXd(measured.reshaped()));
  for (int k = 0, c = 0; k < p.size(); ++k) {
    if (effect.parameters[k].search == Search::kLinear) p[k] *= shares[c++];
  }
  return p;
}

struct Case {
  const char* effect;
  std::vector<const char*> estimates;
  // By which they are judged, of components of a vector; empty: by themselves.
  std::string scale = "";
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
    EXPECT_NEAR(found, expected,
                .1 * std::abs(scale.empty() ? expected : truth.at(scale)))
        << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Effects, EffectTruth,
    testing::Values(
        Case{"viscous_friction", {"viscous"}},
        Case{"coulomb_friction", {"coulomb"}},
        Case{"torque_offset", {"offset"}}, Case{"presliding", {"coulomb"}},
        Case{"armature", {"armature"}}, Case{"elasticity", {"stiffness"}},
        Case{"torque_ripple", {"ripple", "phase"}},
        Case{"torque_gain", {"gain"}}, Case{"torque_deadband", {"deadband"}},
        Case{"torque_crosstalk", {"gain"}}, Case{"delay", {"delay"}},
        Case{"encoder_offset", {"offset"}}, Case{"link_length", {"length"}},
        Case{"base_tilt", {"tilt", "gravity_x", "gravity_y", "gravity_z"}},
        Case{"payload", {"mass", "com_x", "com_y", "com_z"}},
        Case{"added_mass", {"mass"}}, Case{"link_inertia", {"share", "mass"}},
        Case{"external_contact", {"force_x", "force_y", "force_z"}, "force"},
        Case{"time_base", {"rate"}}),
    [](const auto& info) { return info.param.effect; });

}  // namespace armcal::truth_test
