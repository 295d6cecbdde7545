#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/plant/hidden/hidden_plant.h"

namespace armcal::transmissions_test {

// Work of the transmission on its two sides over a closed cycle of deflection
// A sin(w t), from its second on; negative: it takes energy.
double CycleWork(const HiddenPlant& plant, double A, double omega) {
  const Transmission& law = plant.robot.transmissions[0];
  const double dt = 2 * M_PI / omega / 20000;
  double state = 0, rate = 0, work = 0;
  for (int k = 0; k < 40000; ++k) {
    const double phase = omega * k * dt;
    const double rate_of_d = A * omega * std::cos(phase);
    const double torque =
        law.torque(A * std::sin(phase), rate_of_d, &state, &rate);
    state += dt * rate;
    if (k >= 20000) work -= torque * rate_of_d * dt;
  }
  return work;
}

TEST(HiddenTransmissions, ElasticityByHand) {
  HiddenPlant plant("elasticity", 1, {.002, .05});
  EXPECT_EQ(plant.robot.transmissions[0].joint, 1);
  // 10 N m would wind its first slope up by 2 mrad: 5000 N m/rad to 3 N m,
  // 6500 to 10 N m, 7500 beyond.
  EXPECT_NEAR(plant.Value("stiffness"), 5000, 1e-9);
  EXPECT_NEAR(plant.Transmitted(-.0001, 0), -.5, 1e-12);
  EXPECT_NEAR(plant.Transmitted(.0006, 0), 3, 1e-12);
  EXPECT_NEAR(plant.Transmitted(.0016, 0), 3 + 6500 * .001, 1e-12);
  const double end = .0006 + 7 / 6500.;
  EXPECT_NEAR(plant.Transmitted(-end - .001, 0), -10 - 7.5, 1e-9);
  const Transmission& gear = plant.robot.transmissions[0];
  for (const double load : {-20., -4., 0., 2., 9., 30.}) {
    EXPECT_NEAR(plant.Transmitted(gear.initial_deflection(load), 0), load,
                1e-12);
  }
  // Damping 2 zeta sqrt(k I); the motor is given 0.3 of the joint's 2 kg m^2.
  EXPECT_NEAR(plant.Value("armature"), .6, 1e-12);
  EXPECT_NEAR(plant.Transmitted(0, .1), .1 * .1 * std::sqrt(5000 * .6), 1e-12);
  // An armature that is there stays.
  HiddenPlant heavy;
  heavy.robot.robot.links[1].joint.armature = .1;
  heavy.Add("elasticity", 1, {.002, .05});
  EXPECT_EQ(heavy.robot.robot.links[1].joint.armature, .1);
}

// It takes c w A^2 pi per cycle, and nothing when slow.
TEST(HiddenTransmissions, ElasticityTakesItsDampingOnly) {
  const HiddenPlant plant("elasticity", 1, {.002, .05});
  const double c = plant.Value("damping"), A = .003;
  EXPECT_NEAR(CycleWork(plant, A, 50), -c * 50 * A * A * M_PI, 1e-5);
  EXPECT_NEAR(CycleWork(plant, A, 1e-6), 0, 1e-8);
}

TEST(HiddenTransmissions, BacklashHasAGapAndNeverPulls) {
  const HiddenPlant plant("backlash", 0, {.01});
  const double k = plant.Value("contact_stiffness");
  EXPECT_NEAR(k, 10 / .001, 1e-9);
  for (const double d : {-.005, -.003, 0., .0049}) {
    EXPECT_EQ(plant.Transmitted(d, .3), 0) << d;
  }
  EXPECT_NEAR(plant.Transmitted(.006, 0), k * .001, 1e-9);
  EXPECT_NEAR(plant.Transmitted(-.0055, 0), -k * .0005, 1e-9);
  // Harder to press in than out; out never less than nothing.
  EXPECT_NEAR(plant.Transmitted(.006, .25), k * .001 * 1.5, 1e-9);
  EXPECT_NEAR(plant.Transmitted(.006, -.25), k * .001 * .5, 1e-9);
  EXPECT_EQ(plant.Transmitted(.006, -3), 0);
  EXPECT_NEAR(plant.Transmitted(-.006, -.25), -k * .001 * 1.5, 1e-9);
}

// Whatever the load, it starts at rest on the flank that bears it.
TEST(HiddenTransmissions, BacklashStartsPressedOntoAFlank) {
  for (const double gap : {5e-4, .01}) {
    const HiddenPlant plant("backlash", 0, {gap});
    const Transmission& law = plant.robot.transmissions[0];
    for (const double load : {.01, 3., 8., 12., 40.}) {
      EXPECT_NEAR(plant.Transmitted(law.initial_deflection(load), 0), load,
                  1e-9 * load);
      EXPECT_NEAR(plant.Transmitted(law.initial_deflection(-load), 0), -load,
                  1e-9 * load);
    }
    EXPECT_EQ(law.initial_deflection(0), 0);
    EXPECT_EQ(law.stiffest, plant.Value("contact_stiffness"));
  }
  // Flanks give way by 0.2 mrad at least.
  EXPECT_NEAR(HiddenPlant("backlash", 0, {5e-4}).Value("contact_stiffness"),
              10 / 2e-4, 1e-6);
}

TEST(HiddenTransmissions, BacklashTakesEnergyOnItsFlanks) {
  const HiddenPlant plant("backlash", 0, {.01});
  EXPECT_EQ(CycleWork(plant, .004, 30), 0);
  EXPECT_NEAR(CycleWork(plant, .007, 1e-6), 0, 1e-7);
  const double fast = CycleWork(plant, .007, 30);
  EXPECT_LT(fast, -1e-4);
  // Linear in the rate while it never pulls away.
  EXPECT_NEAR(CycleWork(plant, .007, 60) / fast, 2, 1e-3);
}

// At the joint's torque scale it creeps by its share of the speed; at half of
// it by an eighth.
TEST(HiddenTransmissions, BeltCreepsUnderLoad) {
  const HiddenPlant plant("belt_slip", 0, {.001, .002});
  const Transmission& law = plant.robot.transmissions[0];
  double state = 0, rate = 0;
  EXPECT_NEAR(law.torque(.002, 0, &state, &rate), 10, 1e-12);
  EXPECT_NEAR(rate, .001, 1e-12);
  state = .001;
  EXPECT_NEAR(law.torque(.002, 0, &state, &rate), 5, 1e-12);
  EXPECT_NEAR(rate, .001 / 8, 1e-12);
  EXPECT_LT(CycleWork(plant, .002, 1), 0);
}

TEST(HiddenTransmissions, OneJointYieldsOnce) {
  HiddenPlant plant("elasticity", 1, {.002, .05});
  Eigen::VectorXd p(1);
  p << .005;
  const HiddenEffect& backlash = *FindHiddenEffect("backlash");
  EXPECT_EQ(WhyNotApplicable(backlash, plant.robot, 1, p, plant.context),
            "the joint has a transmission that yields already");
  EXPECT_EQ(WhyNotApplicable(backlash, plant.robot, 2, p, plant.context), "");
}

// Torques of the position have a potential: no work around a closed way.
double Around(HiddenPlant* plant, double from, double to) {
  double work = 0;
  const int steps = 20000;
  for (int k = 0; k < steps; ++k) {
    plant->at.position[0] = from + (to - from) * (k + .5) / steps;
    work += plant->Torque() * (to - from) / steps;
  }
  return work;
}

TEST(HiddenPositionTorques, SpringByHand) {
  HiddenPlant plant("spring", 0, {.2, .3});
  plant.at.position[0] = .3;
  EXPECT_EQ(plant.Torque(), 0);
  plant.at.position[0] = .301;
  EXPECT_NEAR(plant.Torque(), -2 * .001, 1e-8);
  plant.at.position[0] = -1.7;  // sinh(1) = 1.1752
  EXPECT_NEAR(plant.Torque(), 2 * 2 * 1.17520, 1e-4);
  // A pure pull back: the same velocity or load changes nothing.
  plant.at.velocity[0] = 3;
  EXPECT_NEAR(plant.Torque(), 2 * 2 * 1.17520, 1e-4);
}

TEST(HiddenPositionTorques, CableSaturates) {
  HiddenPlant plant("cable", 0, {.1, .2, .4});
  plant.at.position[0] = .2;
  EXPECT_EQ(plant.Torque(), 0);
  plant.at.position[0] = .6;
  EXPECT_NEAR(plant.Torque(), -.5, 1e-12);
  plant.at.position[0] = -200;
  EXPECT_NEAR(plant.Torque(), 1, 2e-3);
}

TEST(HiddenPositionTorques, RippleComesBackEveryTooth) {
  HiddenPlant plant("torque_ripple", 0, {.05, 20.3, 0});
  plant.at.position[0] = M_PI / 2 / 20;
  EXPECT_NEAR(plant.Torque(), -.5, 1e-12);
  plant.at.position[0] += 2 * M_PI / 20;
  EXPECT_NEAR(plant.Torque(), -.5, 1e-12);
  EXPECT_NEAR(Around(&plant, 0, 2 * M_PI / 20), 0, 1e-9);
  EXPECT_GT(std::abs(Around(&plant, 0, M_PI / 20)), .04);
}

}  // namespace armcal::transmissions_test
