#include <gtest/gtest.h>

#include <cmath>

#include "model/plant/hidden/joint_friction.h"
#include "tests/model/plant/hidden/hidden_plant.h"

namespace armcal::friction_test {

using Eigen::VectorXd;

TEST(HiddenFriction, ViscousIsItsSlopeAndThins) {
  HiddenPlant plant("viscous_friction", 0, {.1});
  EXPECT_NEAR(plant.TorqueAt(.01), -.01, 1e-8);
  EXPECT_NEAR(plant.TorqueAt(-.01), .01, 1e-8);
  // 10 asinh(3 / 10) = 2.95673.
  EXPECT_NEAR(plant.TorqueAt(3), -2.95673, 1e-5);
  EXPECT_EQ(plant.Value("viscous"), 1);
}

TEST(HiddenFriction, CoulombByHand) {
  HiddenPlant plant("coulomb_friction", 0, {.1});
  EXPECT_EQ(plant.TorqueAt(0), 0);
  EXPECT_NEAR(plant.TorqueAt(.005), -1 / std::sqrt(2), 1e-12);
  EXPECT_NEAR(plant.TorqueAt(-1), 1, 2e-5);
}

TEST(HiddenFriction, AsymmetricDragsOneWay) {
  HiddenPlant forward("asymmetric_friction", 0, {.05});
  // 3 asinh(1 / 3) = 0.98235.
  EXPECT_NEAR(forward.TorqueAt(1), -.98235, 1e-4);
  EXPECT_NEAR(forward.TorqueAt(-1), 0, 1e-4);
  HiddenPlant backward("asymmetric_friction", 0, {-.05});
  EXPECT_NEAR(backward.TorqueAt(1), 0, 1e-4);
  EXPECT_NEAR(backward.TorqueAt(-1), .98235, 1e-4);
}

TEST(HiddenFriction, QuadraticGrowsWithThePower175) {
  HiddenPlant plant("quadratic_friction", 0, {.1});
  EXPECT_NEAR(plant.TorqueAt(1), -1, 1e-4);
  EXPECT_NEAR(plant.TorqueAt(-2), std::pow(2, 1.75), 1e-4);
}

TEST(HiddenFriction, StribeckHalvesAtItsVelocity) {
  HiddenPlant plant("stribeck", 0, {.1, .2});
  EXPECT_NEAR(plant.TorqueAt(.2), -.5, 2e-4);
  EXPECT_NEAR(plant.TorqueAt(-.6), .1, 1e-4);
  EXPECT_NEAR(plant.TorqueAt(.03), -1 / 1.0225, .015);
}

TEST(HiddenFriction, LoadPressesTheTeeth) {
  HiddenPlant plant("load_friction", 0, {.1});
  EXPECT_EQ(plant.TorqueAt(1), 0);
  plant.at.load[0] = 1.5;  // 3-4-5 with a preload of 2
  EXPECT_NEAR(plant.TorqueAt(1), -.1 * .5, 1e-5);
  plant.at.load[0] = -100;
  EXPECT_NEAR(plant.TorqueAt(-1), .1 * 98.02, 1e-3);
}

TEST(HiddenFriction, PositionHasTightSpots) {
  HiddenPlant plant("position_friction", 0, {.1, 2.7, .6});
  plant.at.position[0] = .3;  // 2 q = phase
  EXPECT_NEAR(plant.TorqueAt(1), -1, 1e-4);
  plant.at.position[0] = .3 + M_PI / 2;
  EXPECT_NEAR(plant.TorqueAt(1), -std::exp(-2), 1e-4);
  plant.at.position[0] = .3 + M_PI;  // the next of two per turn
  EXPECT_NEAR(plant.TorqueAt(-1), 1, 1e-4);
}

// Two shafts that turn together feel nothing of each other; else both do, and
// the power is that of their slip.
TEST(HiddenFriction, CoupledFrictionBrakesTheSlip) {
  HiddenPlant plant("coupled_friction", 1, {.1, -.5});
  ASSERT_EQ(plant.robot.joint_laws.size(), 2u);
  EXPECT_EQ(plant.robot.joint_laws[1].joint, 2);
  plant.at.velocity << 9, .5, 1, 9, 9, 9;
  EXPECT_NEAR(plant.Torque(0), 0, 1e-15);
  plant.at.velocity << 9, 1, 0, 9, 9, 9;
  EXPECT_NEAR(plant.Torque(0), -1, 1e-12);
  EXPECT_NEAR(plant.Torque(1), .5, 1e-12);
  EXPECT_EQ(plant.Value("neighbour"), 3);
}

// Warmth takes from the ordinary friction what the law says, and no more: at
// 30 K Vogel's exponent is .02 * 30 * 120 / 150.
TEST(HiddenFriction, WarmJointsRunEasier) {
  HiddenPlant plant;
  plant.robot.robot.links[0].joint.viscous = 2;
  plant.robot.robot.links[0].joint.coulomb = 3;
  AddJointFriction(.005, &plant.robot);
  plant.Add("thermal_friction", 0, {.02, 20, 1});
  const auto both = [&] { return plant.Torque(0) + plant.Torque(1); };
  plant.at.velocity[0] = 1;
  EXPECT_NEAR(both(), -5, 1e-4);
  plant.at.temperature[0] = 30;
  EXPECT_NEAR(both(), -2 * std::exp(-.48) - 3 * std::exp(-.16), 1e-4);
  // 5 W at the usual speed warm the joint by 20 K in the log's 40 s.
  EXPECT_NEAR(plant.robot.thermal[0].resistance, 4, 1e-12);
  EXPECT_NEAR(plant.robot.thermal[0].capacity, 10, 1e-12);
}

TEST(HiddenFriction, OrdinaryFrictionIsTheRobots) {
  HiddenPlant plant("payload", -1, {.01, 0, 0, .1});
  Joint& joint = plant.robot.robot.links[0].joint;
  joint.viscous = 2;
  joint.coulomb = 3;
  joint.offset = -.7;
  AddJointFriction(.005, &plant.robot);
  ASSERT_EQ(plant.robot.joint_laws.size(), 2u);
  EXPECT_TRUE(plant.robot.joint_laws[0].heats);
  EXPECT_FALSE(plant.robot.joint_laws[1].heats);
  EXPECT_NEAR(plant.TorqueAt(-.5), 1 + 3, 1e-3);
  EXPECT_EQ(plant.Torque(1), .7);  // the motor gives the offset: JointTerm
}

// No law without a memory ever gives energy, at any velocity, place or load.
TEST(HiddenFriction, TakesPowerAlways) {
  std::mt19937_64 random(2);
  for (const std::string name :
       {"viscous_friction", "coulomb_friction", "asymmetric_friction",
        "quadratic_friction", "stribeck", "load_friction", "position_friction",
        "coupled_friction", "dragging_brake"}) {
    const HiddenEffect& effect = *FindHiddenEffect(name);
    for (int draw = 0; draw < 50; ++draw) {
      HiddenPlant plant;
      ApplyHiddenEffect(effect, &plant.robot, 2,
                        DrawParameters(effect, &random), plant.context);
      double most = 0;
      for (int k = 0; k < 50; ++k) {
        plant.at.t = Uniform(&random, 0, 40);
        plant.at.position = UniformVector(&random, 6, -3, 3);
        plant.at.velocity = std::pow(10, Uniform(&random, -4, .5)) *
                            UniformVector(&random, 6, -1, 1);
        plant.at.load = UniformVector(&random, 6, -50, 50);
        double power = 0;
        for (const JointLaw& law : plant.robot.joint_laws) {
          EXPECT_TRUE(law.heats) << name;
          power += law.torque(plant.at, nullptr, nullptr) *
                   plant.at.velocity[law.joint];
        }
        EXPECT_LE(power, 0) << name;
        most = std::min(most, power);
      }
      EXPECT_LT(most, 0) << name;
    }
  }
}

// Integrates a law with a state along q(t) and gives torque over position.
struct Cycle {
  double work = 0;  // on the joint
  std::vector<double> q, torque;
};
Cycle Drive(HiddenPlant* plant, double amplitude, double omega,
            double periods) {
  const double dt = 1e-5;
  Cycle cycle;
  double state = 0, rate = 0;
  const long steps = std::lround(periods * 2 * M_PI / omega / dt);
  for (long k = 0; k < steps; ++k) {
    plant->at.position[0] = amplitude * std::sin(omega * k * dt);
    plant->at.velocity[0] = amplitude * omega * std::cos(omega * k * dt);
    const double torque = plant->Torque(0, &state, &rate);
    state += dt * rate;
    if (k * dt * omega > 2 * M_PI) {  // settled
      cycle.work += torque * plant->at.velocity[0] * dt;
    }
    if (k % 100 == 0) {
      cycle.q.push_back(plant->at.position[0]);
      cycle.torque.push_back(torque);
    }
  }
  return cycle;
}

// Bristles: a spring F / z for small motion; friction for large motion. After a
// reversal F (1 - b / z) = F / (x / z + 1/2) is missing: F z log(1 + 4 A / z)
// of each stroke's work 2 F A.
TEST(HiddenFriction, PreslidingHoldsThenSlips) {
  HiddenPlant small("presliding", 0, {.1, .02});
  const Cycle held = Drive(&small, 2e-4, .5, 1);
  for (size_t k = 0; k < held.q.size(); ++k) {
    EXPECT_NEAR(held.torque[k], -1 / .02 * held.q[k], .03 / .02 * 2e-4);
  }
  HiddenPlant large("presliding", 0, {.1, .005});
  const Cycle slipped = Drive(&large, .5, 1, 3);
  EXPECT_NEAR(slipped.work, -4 * (1 - .005 * std::log(401)), .01);
}

// Right after a reversal the friction is F, a distance L later F / e of it is
// left, and a circle of motion costs 4 F L, however long the way.
TEST(HiddenFriction, ApproachFrictionFadesWithTheWay) {
  HiddenPlant plant("approach_friction", 0, {.1, .1});
  const Cycle cycle = Drive(&plant, .8, 1, 3);
  // Two cycles of two strokes; sinks from F as exp(-x / L) along each.
  EXPECT_NEAR(cycle.work, -2 * 2 * 1 * .1, .02);
  double state = -1, rate = 0;
  plant.at.velocity[0] = 1;
  EXPECT_NEAR(plant.Torque(0, &state, &rate), -1, 1e-4);
  state = -1 + 2 * (1 - std::exp(-1));
  EXPECT_NEAR(plant.Torque(0, &state, &rate), -std::exp(-1), 1e-4);
}

}  // namespace armcal::friction_test
