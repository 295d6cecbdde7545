#include "model/effects/effects.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "model/dynamics/recorded_torque.h"
#include "model/signals/low_pass.h"
#include "tests/model/effects/every_effect.h"

namespace armcal::effects_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Search = EffectParameter::Search;

TEST(Effects, AreThoseOfTheDesignInItsOrder) {
  std::vector<std::string> names;
  for (const Effect& effect : Effects()) names.push_back(effect.name);
  EXPECT_THAT(
      names,
      testing::ElementsAre(
          "viscous_friction", "coulomb_friction", "torque_offset",
          "asymmetric_friction", "quadratic_friction", "stribeck",
          "load_friction", "position_friction", "coupled_friction",
          "presliding", "armature", "elasticity", "backlash", "spring", "cable",
          "torque_ripple", "torque_gain", "torque_gain_of_all_joints",
          "torque_nonlinearity", "torque_saturation", "torque_deadband",
          "torque_crosstalk", "delay", "encoder_offset", "link_length",
          "base_tilt", "payload", "added_mass", "link_inertia",
          "thermal_friction", "viscous_friction_of_all_joints", "time_drift",
          "external_contact", "vibration", "time_base"));
  EXPECT_EQ(FindEffect("payload")->name, "payload");
  EXPECT_EQ(FindEffect("gremlins"), nullptr);
}

class EffectOf : public EveryEffect {};

TEST_P(EffectOf, ParametersSayWhatTheyAre) {
  const Effect& effect = GetParam();
  for (const std::string& text :
       {effect.law, effect.shows, effect.experiment}) {
    EXPECT_FALSE(text.empty());
  }
  ASSERT_FALSE(effect.parameters.empty());
  EXPECT_EQ(effect.parameters[0].search, Search::kLinear);
  std::set<std::string> names;
  for (const EffectParameter& parameter : effect.parameters) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_FALSE(parameter.unit.empty());
    EXPECT_EQ(static_cast<bool>(parameter.grid),
              parameter.search == Search::kGrid ||
                  parameter.search == Search::kRefined)
        << parameter.name;
  }
}

TEST_P(EffectOf, SizesAndGridsAreOfUse) {
  Everywhere([&](const EffectArm& arm, int joint, const VectorXd& sizes,
                 RecordedTorque*) {
    EXPECT_TRUE(sizes.allFinite());
    for (int k = 0; k < sizes.size(); ++k) {
      const EffectParameter& parameter = GetParam().parameters[k];
      if (parameter.search == Search::kLinear) {
        EXPECT_GT(sizes[k], 0);
      }
      if (!parameter.grid) continue;
      const std::vector<double> grid = parameter.grid(arm.Site(joint));
      EXPECT_THAT(grid.size(),
                  testing::AllOf(testing::Ge(1u), testing::Le(8u)));
      // Of what is refined only, what is tried may be an end of the range.
      const int ends = parameter.search == Search::kRefined ? 1 : 0;
      EXPECT_TRUE(std::is_sorted(grid.begin(), grid.end())) << parameter.name;
      EXPECT_TRUE(std::is_sorted(grid.begin() + ends, grid.end() - ends,
                                 std::less_equal<>()))
          << parameter.name;
      EXPECT_THAT(grid, testing::Contains(sizes[k]));
    }
    for (const EffectEstimate& estimate :
         EstimatesOf(GetParam(), arm.Site(joint), sizes)) {
      EXPECT_TRUE(std::isfinite(estimate.value)) << estimate.name;
      EXPECT_THAT(estimate.unit, testing::Not(testing::HasSubstr("E")));
    }
  });
}

// At every corner of the grids the torque that the effect adds is finite, some,
// and none where its linear parameters are 0.
TEST_P(EffectOf, AddsTorqueAndNoneAtZero) {
  Everywhere([&](const EffectArm& arm, int joint, const VectorXd& sizes,
                 RecordedTorque* recorded) {
    for (const bool last : {false, true}) {
      VectorXd p = sizes, zero = sizes;
      for (int k = 0; k < p.size(); ++k) {
        const EffectParameter& parameter = GetParam().parameters[k];
        if (parameter.search == Search::kLinear) zero[k] = 0;
        if (!parameter.grid) continue;
        const std::vector<double> grid = parameter.grid(arm.Site(joint));
        p[k] = zero[k] = last ? grid.back() : grid.front();
      }
      const MatrixXd change = arm.Change(GetParam(), joint, p, recorded);
      EXPECT_TRUE(change.allFinite());
      // Little of a gap where the load keeps its sign.
      EXPECT_GT(change.norm(), 1e-7 * recorded->nominal().norm());
      EXPECT_LT(arm.Change(GetParam(), joint, zero, recorded).norm(),
                1e-9 * change.norm());
    }
  });
}

// As far as a diagnosis looks: to 6 Hz, half a second after the start.
TEST_P(EffectOf, IsLinearInItsLinearParameters) {
  // Of which only a share near 1 is a limit.
  if (GetParam().name == "torque_saturation") return;
  // A wider gap takes longer to cross.
  if (GetParam().name == "backlash") return;
  double tolerance = .03;
  // The mode of a softer gear rings slower.
  if (GetParam().name == "elasticity") tolerance = .1;
  // A share of exp(-.1) and of exp(-.2) is left at the usual rise of 20 K.
  if (GetParam().name == "thermal_friction") tolerance = .05;
  Everywhere([&](const EffectArm& arm, int joint, const VectorXd& sizes,
                 RecordedTorque* recorded) {
    const auto slow = [&](const VectorXd& p) {
      const MatrixXd change = ZeroPhaseLowPass(
          arm.Change(GetParam(), joint, p, recorded), 1 / arm.motion.dt, 6);
      return MatrixXd(change.middleRows(50, change.rows() - 100));
    };
    for (int k = 0; k < sizes.size(); ++k) {
      if (GetParam().parameters[k].search != Search::kLinear) continue;
      VectorXd once = sizes;
      for (int i = 0; i < sizes.size(); ++i) {
        const bool linear = GetParam().parameters[i].search == Search::kLinear;
        if (linear && i != k) once[i] = 0;
      }
      VectorXd twice = once;
      twice[k] *= 2;
      const MatrixXd doubled = slow(twice);
      EXPECT_LE((doubled - 2 * slow(once)).norm(),
                tolerance * doubled.norm() + 1e-12 * recorded->nominal().norm())
          << GetParam().parameters[k].name;
    }
  });
}

// Its own joint, where it would be felt, tells nothing while it is held.
TEST(WhatALinkCarries, IsNotFeltBeyondJointsThatStand) {
  EffectArm arm("SCARA RRPR");
  arm.motion.qd.col(0).setZero();
  arm.motion.qdd.col(0).setZero();
  arm.motion.q.col(0).setConstant(.3);
  arm.SetScale();
  RecordedTorque recorded = arm.Recorded();
  for (const char* name : {"link_length", "added_mass", "link_inertia"}) {
    const Effect& effect = *FindEffect(name);
    const MatrixXd first =
        arm.Change(effect, 0, arm.Sizes(effect, 0), &recorded);
    EXPECT_LT(first.rightCols(3).cwiseAbs().maxCoeff(), 1e-9) << name;
    EXPECT_NE(effect.unfit(arm.Site(0)), "") << name;
    const MatrixXd second =
        arm.Change(effect, 1, arm.Sizes(effect, 1), &recorded);
    EXPECT_GT(second.col(1).cwiseAbs().maxCoeff(), 1e-3) << name;
    EXPECT_EQ(effect.unfit(arm.Site(1)), "") << name;
  }
}

// A passive joint's torques say nothing of a motor, whose gain of -1 would
// explain them.
TEST(WhatAMotorMakes, IsNotToldWhereNoTorqueIsRecorded) {
  EffectArm arm("SCARA RRPR");
  arm.scale.top_torque = Eigen::Vector4d(0, 3, 3, 3);
  for (const char* name : {"torque_gain", "torque_offset", "torque_deadband",
                           "torque_nonlinearity", "torque_saturation"}) {
    const Effect& effect = *FindEffect(name);
    EXPECT_NE(effect.unfit(arm.Site(0)), "") << name;
    EXPECT_EQ(effect.unfit(arm.Site(1)), "") << name;
  }
}

// tau = m c^2 qdd + m g c sin q of a point mass m at c below the axis, whose
// weight on the axis nothing shows.
TEST(PayloadOfAPendulum, IsAPointMass) {
  constexpr double kMass = .4, kLever = .5;
  Robot robot;
  robot.links.resize(1);
  Link& link = robot.links[0];
  // The axis along y of a link that hangs along -z.
  link.X_PF.linear() =
      Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()).matrix();
  link.X_ML = link.X_PF.inverse();
  link.inertial = InertialParameters::FromVector(
      (Vector10d() << .5, 0, 0, -.2, .09, 0, .09, 0, 0, .01).finished());
  std::mt19937_64 random(1);
  const Log log = RecordMotion(RandomMultisine(&random, 1, 2), 8, .01);
  Motion motion;
  motion.dt = .01;
  motion.q = log.q;
  motion.qd = log.qd;
  motion.qdd = log.qdd;
  const Effect& payload = *FindEffect("payload");
  const EffectSite site = {&robot, -1, nullptr};
  const VectorXd p =
      (VectorXd(5) << kMass * kLever * kLever, .0, 0, -kMass * kLever, 0)
          .finished();
  SimulatedRobot changed;
  changed.robot = robot;
  payload.apply(site, p, &changed);
  const VectorXd tau =
      RecordedTorque(robot, std::vector<CoulombTransition>(1), motion)
          .Change(changed);
  const VectorXd truth =
      kMass * kLever *
      (kLever * log.qdd.array() + 9.81 * log.q.array().sin()).matrix();
  EXPECT_LT((tau - truth).norm(), 1e-4 * truth.norm());
  const auto estimates = EstimatesOf(payload, site, p);
  EXPECT_NEAR(estimates[0].value, kMass, 1e-12);
  EXPECT_NEAR(estimates[3].value, -kLever, 1e-12);
}

// A length is a distance, and one of twice the file's is of another arm. The
// second link of a PUMA is .4318 m long (Corke and Armstrong-Helouvry 1994).
TEST(Effects, LinksAreAsLongAsTheirs) {
  const EffectArm arm("PUMA560 6R");
  const Effect& length = *FindEffect("link_length");
  const auto is_plausible = [&](double more) {
    return length.plausible(arm.Site(1), {{"length", "m", more}});
  };
  EXPECT_TRUE(is_plausible(-.43));
  EXPECT_TRUE(is_plausible(.43));
  EXPECT_FALSE(is_plausible(-.44));
  EXPECT_FALSE(is_plausible(.44));
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EffectOf, testing::ValuesIn(Effects()),
                         [](const auto& info) { return info.param.name; });

// A load has a centre of mass within an arm's reach of the last link.
TEST(Effects, PayloadsAreWithinReach) {
  const EffectArm arm("PUMA560 6R");
  const Effect& payload = *FindEffect("payload");
  const auto is_plausible = [&](std::vector<double> p) {
    return payload.plausible(
        arm.Site(-1),
        EstimatesOf(payload, arm.Site(-1),
                    Eigen::Map<const Eigen::VectorXd>(p.data(), p.size())));
  };
  EXPECT_TRUE(is_plausible({2, .2, 0, 0, 0}));
  EXPECT_FALSE(is_plausible({.1, 2, 0, 0, 0}));
  double moving = 0;
  for (const Link& link : arm.robot.links) moving += link.inertial.mass;
  EXPECT_TRUE(is_plausible({moving, 0, 0, 0, 0}));
  EXPECT_FALSE(is_plausible({4 * moving, 0, 0, 0, 0}));
  const double untold = std::nan("");
  EXPECT_TRUE(payload.plausible(
      arm.Site(-1), {{"mass", "kg", untold}, {"com_x", "m", untold}}));
  EXPECT_FALSE(is_plausible({0, .2, 0, 0, 0}));
  EXPECT_TRUE(is_plausible({0, 0, 0, 0, .01}));
}

}  // namespace armcal::effects_test
