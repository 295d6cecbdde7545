// Campaigns with an effect in a law of its own (tests/fixtures/hidden_poses.h):
// it is named with its place and size, and nothing is where there is none.

#include "calib/poses/diagnosis/diagnosis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/poses/diagnosis/report.h"
#include "model/dynamics/forward_dynamics.h"
#include "tests/fixtures/hidden_poses.h"

namespace armcal::diagnosis_test {

HiddenPoseEffect Hidden(const std::string& name, double size, int joint = -1,
                        int by = -1) {
  HiddenPoseEffect effect;
  effect.name = name;
  effect.size = size;
  effect.joint = joint;
  effect.by = by;
  effect.direction = Eigen::Vector3d(1, 2, -2) / 3;
  effect.phase = 1;
  return effect;
}

HiddenPoseEffect Stretch(HiddenPoseEffect effect, int begin, int end = -1) {
  effect.begin = begin;
  effect.end = end;
  return effect;
}

PoseDiagnosis Diagnose(const HiddenPoses& arm,
                       const std::vector<HiddenPoseEffect>& effects) {
  return DiagnosePoseGap(arm.nominal(), arm.Measure(effects, kNoise, 5), {});
}

const PoseFinding* Find(const PoseDiagnosis& diagnosis,
                        const HiddenPoseEffect& effect) {
  for (const PoseFinding& finding : diagnosis.findings) {
    const PosePlace& place = finding.placed.place;
    if (finding.placed.effect->name == effect.name &&
        place.joint == effect.joint && place.by == effect.by) {
      return &finding;
    }
  }
  return nullptr;
}

TEST(PoseDiagnosis, NamesOneEffectWithItsSize) {
  const HiddenPoses arm("PUMA560 6R", Instrument::kTargets, 1, 60, 11);
  for (const auto& effect :
       {Hidden("coupling", .005, 4, 3), Hidden("gear_ratio", -.003, 1),
        Hidden("eccentricity", .002, 2)}) {
    SCOPED_TRACE(effect.name);
    const PoseDiagnosis diagnosis = Diagnose(arm, {effect});
    ASSERT_EQ(diagnosis.findings.size(), 1u);
    const PoseFinding* found = Find(diagnosis, effect);
    ASSERT_NE(found, nullptr) << diagnosis.findings[0].name;
    EXPECT_GT(found->probability, .9);
    EXPECT_EQ(diagnosis.verdict, PoseVerdict::kExplained);
    EXPECT_LT(diagnosis.gap.held_out_after, 3 * kNoise);
    const PoseAmount& first = found->amounts[0];
    // a sin q of s sin(q + phase) is s cos(phase).
    const bool harmonic = found->amounts.size() == 2;
    const double truth = effect.size * (harmonic ? std::cos(effect.phase) : 1);
    // Twice the half-width of 95 %: 1e-4 by chance.
    EXPECT_NEAR(first.value, truth, 2 * first.half_width);
    EXPECT_LT(first.half_width, .2 * std::abs(effect.size));
  }
}

// Sag and a step each look like a smear as long as the other is not fitted.
TEST(PoseDiagnosis, NamesTwoThatHideEachOther) {
  const HiddenPoses arm("UR5 6R", Instrument::kTargets, 1, 80, 12);
  const auto step = Stretch(Hidden("tool_step", 2e-3), 25);
  const auto sag = Hidden("sag", 2e-3);
  const PoseDiagnosis diagnosis = Diagnose(arm, {sag, step});
  const PoseFinding* found = Find(diagnosis, step);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->placed.place.begin, 25);
  EXPECT_NEAR(found->displacement_max, 2e-3, 2e-4);
  EXPECT_NE(Find(diagnosis, sag), nullptr);
  EXPECT_LT(diagnosis.gap.held_out_after, .1 * diagnosis.gap.held_out_geometry);
}

// Joints give way with their load. What moves them against it has another name,
// or none.
TEST(PoseDiagnosis, NoJointRisesUnderItsLoad) {
  const HiddenPoses arm("UR5 6R", Instrument::kTargets, 1, 80, 12);
  for (const double size : {2e-3, -2e-3}) {
    const PoseDiagnosis diagnosis = Diagnose(arm, {Hidden("sag", size)});
    EXPECT_EQ(Find(diagnosis, Hidden("sag", size)) != nullptr, size > 0);
    for (const PoseFinding& finding : diagnosis.findings) {
      const std::string& name = finding.placed.effect->name;
      if (name.find("sag") == std::string::npos) continue;
      if (name == "base_sag" || name == "tool_sag") continue;
      for (const PoseAmount& amount : finding.amounts) {
        EXPECT_GE(amount.value, 0) << name << " " << amount.name;
      }
    }
  }
}

// The same arm by a file whose zeros are 5 degrees off: loads are those of
// where joints stand, and so are findings.
TEST(PoseDiagnosis, AZeroThatIsOffChangesNoFinding) {
  const HiddenPoses arm("UR5 6R", Instrument::kTargets, 1, 80, 12);
  const auto sag = Hidden("sag", 2e-3);
  const PoseMeasurements m = arm.Measure({sag}, kNoise, 5);
  PoseMeasurements off = m;
  constexpr double kOff = 5 * M_PI / 180;
  off.q.col(1).array() -= kOff;
  const PoseDiagnosis by_file = DiagnosePoseGap(arm.nominal(), m, {});
  const PoseDiagnosis by_other = DiagnosePoseGap(arm.nominal(), off, {});
  const PoseFinding* a = Find(by_file, sag);
  const PoseFinding* b = Find(by_other, sag);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->amounts.size(), b->amounts.size());
  for (size_t k = 0; k < a->amounts.size(); ++k) {
    EXPECT_NEAR(a->amounts[k].value, b->amounts[k].value,
                .1 * a->amounts[k].half_width + 2e-5)
        << a->amounts[k].name;
  }
  EXPECT_NEAR(by_other.model.campaign.zeros[1], kOff, .02);
  EXPECT_THAT(PoseDiagnosisReport(arm.nominal(), off, by_other),
              testing::HasSubstr("zeros are off the robot file's: " +
                                 arm.nominal().links[1].joint.name));
}

TEST(PoseDiagnosis, NamesTheStretchOfAMovedTarget) {
  const HiddenPoses arm("PUMA560 6R", Instrument::kPoses, 0, 70, 13);
  const auto window = Stretch(Hidden("tool_window", 1e-3), 20, 44);
  const PoseDiagnosis diagnosis = Diagnose(arm, {window});
  const PoseFinding* found = Find(diagnosis, window);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->placed.place.begin, 20);
  EXPECT_EQ(found->placed.place.end, 44);
  EXPECT_GT(found->interleaved.removed_share, .9);
}

// An elbow counted from the ground, which few poses show.
TEST(PoseDiagnosis, GivesNoPosesUpThatACouplingExplains) {
  Plant plant("PUMA560 6R", 3);
  Eigen::VectorXd held = Eigen::VectorXd::Constant(6, std::nan(""));
  held[1] = .3;
  auto m = plant.Measure(Instrument::kTargets, 40, kNoise, held);
  const auto moved = plant.Measure(Instrument::kTargets, 8, kNoise);
  m.q.conservativeResize(48, Eigen::NoChange);
  m.q.bottomRows(8) = moved.q;
  for (int t = 0; t < 3; ++t) {
    m.targets[t].conservativeResize(48, Eigen::NoChange);
    m.targets[t].bottomRows(8) = moved.targets[t];
  }
  m.row.resize(48, 2);
  m.q.col(2) += m.q.col(1);
  const auto diagnosis = DiagnosePoseGap(plant.nominal, m, {});
  ASSERT_FALSE(diagnosis.findings.empty());
  const PoseFinding& found = diagnosis.findings[0];
  EXPECT_EQ(found.placed.effect->name, "coupling");
  EXPECT_EQ(found.placed.place.joint, 2);
  EXPECT_EQ(found.placed.place.by, 1);
  EXPECT_NEAR(found.amounts[0].value, -1, 2 * found.amounts[0].half_width);
  EXPECT_LT(diagnosis.gap.held_out_after, 5 * kNoise);
}

// An arm whose masses are known, and whose joints 2 and 3 give way.
struct SaggingArm {
  SaggingArm() {
    for (Robot* robot : {&plant.nominal, &plant.robot}) {
      for (int i = 0; i < 6; ++i) {
        robot->links[i].inertial = InertialParameters::FromCenterOfMass(
            8 - i, Eigen::Vector3d(-.1, .02, .03), Eigen::Matrix3d::Identity());
      }
    }
    m = plant.Measure(Instrument::kTargets, 60, kNoise);
    for (Eigen::Index k = 0; k < m.q.rows(); ++k) {
      const Eigen::VectorXd standing = m.q.row(k);
      const Eigen::VectorXd held = GravityTorque(plant.robot, standing);
      // Springs harden by a twentieth.
      for (int j = 0; j < 3; ++j) {
        const double moment = -held[j] / (1 + 5e-4 * std::abs(held[j]));
        m.q(k, j) -= compliance[j] * moment;
      }
    }
  }
  // What is found with compliances that logs have told.
  PoseFinding Sag(const std::vector<Told>& told) const {
    PoseDiagnosisOptions options;
    options.weighed = true;
    options.compliance = told;
    const auto diagnosis = DiagnosePoseGap(plant.nominal, m, options);
    EXPECT_EQ(diagnosis.findings.size(), 1u);
    EXPECT_EQ(diagnosis.findings[0].placed.effect->name, "sag");
    return diagnosis.findings[0];
  }
  // Of joint j, from 0.
  PoseAmount Of(const PoseFinding& sag, int j) const {
    for (const PoseAmount& amount : sag.amounts) {
      if (amount.name == plant.nominal.links[j].joint.name) return amount;
    }
    ADD_FAILURE() << "no compliance of joint " << j + 1;
    return {};
  }
  Plant plant{"PUMA560 6R", 8};
  Eigen::Vector3d compliance{0, 4e-5, 9e-5};  // rad / (N m)
  PoseMeasurements m;
};

TEST(PoseDiagnosis, OfAWeighedArmTellsCompliance) {
  const SaggingArm arm;
  const PoseFinding sag = arm.Sag({});
  for (const int j : {1, 2}) {
    const PoseAmount amount = arm.Of(sag, j);
    EXPECT_EQ(amount.unit, "rad/(N m)");
    EXPECT_NEAR(amount.value, arm.compliance[j],
                2 * amount.half_width + .06 * arm.compliance[j]);
    EXPECT_LT(amount.half_width, .2 * arm.compliance[j]);
  }
}

// What logs say of a joint's elasticity and what poses say of its sag are one
// number: more precise than each, and each is still told by itself.
TEST(PoseDiagnosis, ComplianceByLogsAndPosesIsOne) {
  const SaggingArm arm;
  const PoseAmount alone = arm.Of(arm.Sag({}), 2);
  std::vector<Told> told(6);
  told[2] = {.97 * arm.compliance[2], alone.half_width / 1.96};
  const PoseAmount both = arm.Of(arm.Sag(told), 2);
  EXPECT_NEAR(both.half_width, alone.half_width / std::sqrt(2),
              .1 * alone.half_width);
  EXPECT_NEAR(both.value, (alone.value + told[2].value) / 2,
              .1 * alone.half_width);
  EXPECT_EQ(both.by_poses.value, alone.value);
  EXPECT_LT(both.Apart(), 3);
  // A spring of half the stiffness is another one.
  told[2].value = 2 * arm.compliance[2];
  EXPECT_GT(arm.Of(arm.Sag(told), 2).Apart(), 3);
}

// An encoder on the joint that errs with the motor's angle, where it stands.
TEST(PoseDiagnosis, NamesWhatErrsOnceInTheMotorsTurn) {
  Plant plant("UR5 6R", 9);
  PoseMeasurements m = plant.Measure(Instrument::kTargets, 70, kNoise);
  m.q.col(1).array() -= 8e-4 * (50 * m.q.col(1).array() + 1).sin();
  PoseDiagnosisOptions options;
  options.gear_ratios = {100, 50, 50, -80, 80, 1};
  const auto diagnosis = DiagnosePoseGap(plant.nominal, m, options);
  ASSERT_EQ(diagnosis.findings.size(), 1u);
  const PoseFinding& found = diagnosis.findings[0];
  EXPECT_EQ(found.placed.effect->name, "motor_harmonic");
  EXPECT_EQ(found.placed.place.joint, 1);
  EXPECT_EQ(found.placed.place.parts, 1);
  EXPECT_NEAR(std::hypot(found.amounts[0].value, found.amounts[1].value), 8e-4,
              8e-5);
  EXPECT_LT(diagnosis.gap.held_out_after, 3 * kNoise);
}

TEST(PoseDiagnosis, NamesNothingWhereGeometryIsAllThereIs) {
  for (const auto instrument :
       {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
    const bool wire = instrument == Instrument::kWire;
    const HiddenPoses arm("UR5 6R", instrument, 1, wire ? 120 : 50, 14);
    auto m = arm.Measure({}, kNoise, 6);
    auto wrong = m;  // a gross error is one pose, and no effect
    if (wire) wrong.lengths[7] += .1;
    for (auto& target : wrong.targets) target(7, 0) += .1;
    if (wrong.poses.size() > 0) wrong.poses(7, 0) += .1;
    for (const PoseMeasurements& campaign : {m, wrong}) {
      const auto diagnosis = DiagnosePoseGap(arm.nominal(), campaign, {});
      EXPECT_TRUE(diagnosis.findings.empty());
      EXPECT_EQ(diagnosis.verdict, PoseVerdict::kNoiseFloor);
    }
  }
}

}  // namespace armcal::diagnosis_test
