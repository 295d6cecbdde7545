// What simulated logs show of friction and transmissions: printed as a table,
// effect, what is measured, its value in the log, its value by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "model/plant/hidden/scenario.h"
#include "tests/model/plant/hidden/hidden_runs.h"

namespace armcal::friction_physics_test {

using Eigen::VectorXd;

// A wheel needs no torque at constant velocity but for its friction.
const std::vector<double> kVelocities = {1, -1, .5, -.5, .1, -.1};

TEST(HiddenFrictionPhysics, OfTheVelocity) {
  const HiddenLoop loop(Wheel(), Plateaus(kVelocities, .5));
  const HiddenRun free = loop.Without();
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(free.Plateau(k), 0, 1e-3);
  HiddenRun run = loop.Run("viscous_friction", 0, {.1});
  CheckEffect("viscous_friction", "torque at 1 rad/s", run.Plateau(0), 1, .01);
  CheckEffect("viscous_friction", "torque at -0.1 rad/s", run.Plateau(5), -.1,
              .002);
  run = loop.Run("coulomb_friction", 0, {.1});
  CheckEffect("coulomb_friction", "torque at 1 rad/s", run.Plateau(0), 1, .01);
  CheckEffect("coulomb_friction", "torque at -0.1 rad/s", run.Plateau(5), -1,
              .01);
  run = loop.Run("asymmetric_friction", 0, {-.05});
  CheckEffect("asymmetric_friction", "torque at 1 rad/s", run.Plateau(0), 0,
              .005);
  CheckEffect("asymmetric_friction", "torque at -1 rad/s", run.Plateau(1), -1,
              .025);
  run = loop.Run("quadratic_friction", 0, {.1});
  CheckEffect("quadratic_friction", "torque at 1 rad/s", run.Plateau(0), 1,
              .01);
  CheckEffect("quadratic_friction", "of 1 over that of 0.5 rad/s",
              run.Plateau(0) / run.Plateau(2), std::pow(2, 1.75), .05);
  run = loop.Run("stribeck", 0, {.1, .1});
  CheckEffect("stribeck", "torque at its velocity, half", run.Plateau(4), .5,
              .01);
  CheckEffect("stribeck", "torque at ten times that, gone", run.Plateau(0),
              1 / 101., .01);
}

// At the velocity of the scenario's width the friction is F / sqrt(2), the
// arm's own and an effect's alike.
TEST(HiddenFrictionPhysics, PassesZeroVelocityAsTheScenarioSays) {
  Scenario scenario;
  scenario.model = Wheel();
  scenario.model.links[0].joint.coulomb = 3;
  scenario.zero_velocity = .05;
  const Profile profile = Plateaus({.05}, 1);
  scenario.motion = {profile.duration, [&profile](double t) {
                       const Eigen::Vector3d at = profile.at(t);
                       return ReferencePoint{at.segment(0, 1), at.segment(1, 1),
                                             at.segment(2, 1)};
                     }};
  scenario.loop.controller =
      DefaultController(scenario.model, VectorXd::Zero(1), 10);
  scenario.effects = {
      {FindHiddenEffect("coulomb_friction"), 0, VectorXd::Constant(1, .3)}};
  const ScenarioRun run = RunScenario(scenario);
  const double both = 3 + run.effects[0].values[0].value;
  EXPECT_GT(both, 3.5);
  EXPECT_NEAR(run.run.log.tau(280, 0), both / std::sqrt(2), .005 * both);
}

// Up less down at one position: twice the friction, without gravity.
TEST(HiddenFrictionPhysics, OfLoadAndPosition) {
  HiddenLoop loop(Pendulum(), Plateaus({.5, -.5, .5, -.5}, 1));
  loop.held = 1;
  loop.q0[0] = -.25;
  const auto friction = [](const HiddenRun& run, double q) {
    return (run.TorqueNear(q, 1) - run.TorqueNear(q, -1)) / 2;
  };
  EXPECT_NEAR(friction(loop.Without(), 0), 0, .005);
  HiddenRun run = loop.Run("load_friction", 0, {.1});
  CheckEffect("load_friction", "friction under the weight held level",
              friction(run, 0), .1 * (std::hypot(kWeight, 2) - 2), .01);
  HiddenLoop turn(Wheel(), Plateaus({1.5, -1.5}, 2.5));
  EXPECT_NEAR(friction(turn.Without(), 1), 0, .005);
  run = turn.Run("position_friction", 0, {.1, 2, .8});
  CheckEffect("position_friction", "friction at the tight spot",
              friction(run, .4 + M_PI), 1, .02);
  CheckEffect("position_friction", "friction a quarter turn on",
              friction(run, .4 + M_PI / 2), std::exp(-2), .02);
}

// The neighbour's motion needs torque here.
TEST(HiddenFrictionPhysics, OfANeighbour) {
  HiddenLoop loop(EasyRobot({EasyLink("a", Axis::kUpright),
                             EasyLink("b", Axis::kUpright, 1e-9)}),
                  Plateaus({1, -1}, .5), 1);
  // Both turn about one axis: the moving link's mass throws nothing sideways.
  EXPECT_NEAR(loop.Without().Plateau(0), 0, .005);
  const HiddenRun run = loop.Run("coupled_friction", 0, {.1, .6});
  CheckEffect("coupled_friction", "torque at rest, neighbour at 1 rad/s",
              run.Plateau(0), std::asinh(2) / std::asinh(1 / .3), .01);
  CheckEffect("coupled_friction", "torque at rest, neighbour at -1 rad/s",
              run.Plateau(1), -std::asinh(2) / std::asinh(1 / .3), .01);
}

TEST(HiddenFrictionPhysics, WithAMemory) {
  HiddenLoop loop(Wheel(), Sine(5e-5, .5, 4));
  HiddenRun run = loop.Run("presliding", 0, {.1, .02});
  // Torque over displacement, less the inertia's.
  const VectorXd q = run.log.q.col(0).array() - run.log.q.col(0).mean();
  const double slope = q.dot(run.log.tau.col(0)) / q.squaredNorm() +
                       (kInertia + kMotor) * std::pow(2 * M_PI * .5, 2);
  CheckEffect("presliding", "stiffness while it sticks, N m/rad", slope,
              1 / .02, 1);
  loop.profile = Plateaus({.5, -.5}, 2);
  loop.held = 2;
  run = loop.Run("presliding", 0, {.1, .02});
  // F (1 - 1 / (x / z + 1/2)) a way x after the reversal, 0.7 rad on average.
  CheckEffect("presliding", "friction once it slips", run.Plateau(1),
              -1 + 1 / 35.5, .01);
  run = loop.Run("approach_friction", 0, {.1, .2});
  const double turn = run.log.q.col(0).maxCoeff();
  CheckEffect("approach_friction", "0.2 rad after the reversal",
              run.TorqueNear(turn - .2, -1), -std::exp(-1), .02);
  CheckEffect("approach_friction", "0.2 rad before the next",
              run.TorqueNear(turn - .8, -1), -std::exp(-4), .02);
}

TEST(HiddenFrictionPhysics, OfABrake) {
  HiddenLoop loop(Wheel(), Plateaus({1}, 4));
  loop.context.duration = 4;
  const HiddenRun run = loop.Run("dragging_brake", 0, {.1, .2});
  const VectorXd drag = (run.log.tau - loop.Without().log.tau).topRows(2000);
  CheckEffect("dragging_brake", "mean over its torque: share of time",
              drag.mean(), .2, .03);
  // All but the spans and their flanks of some 50 ms to either side.
  CheckEffect("dragging_brake", "share of the time without drag",
              (drag.array().abs() < .1).cast<double>().mean(), .7, .1);
}

// Constant velocity: torque falls as the logged temperature says.
TEST(HiddenFrictionPhysics, Warms) {
  Robot robot = Wheel();
  robot.links[0].joint.viscous = 3;
  HiddenLoop loop(robot, Plateaus({1}, 5));
  loop.friction = true;
  loop.log_links = false;
  loop.context.time_scale = 5;
  const HiddenRun run = loop.Run("thermal_friction", 0, {.04, 20, .5});
  const auto at = [&run](const Eigen::MatrixXd& signal, double t) {
    return run.Mean(signal, t - .1, t + .1);
  };
  // Of viscous friction, by Vogel's law around 25 deg C.
  const auto left = [](double T) {
    return std::exp(-.04 * T * 120 / (120 + T));
  };
  CheckEffect("thermal_friction", "torque after warming over before",
              at(run.log.tau, 4.5) / at(run.log.tau, 1),
              left(at(run.log.temperature, 4.5) - 25) /
                  left(at(run.log.temperature, 1) - 25),
              .005);
  // 3 W of what is left against 20 K / 3 W and 2.5 s, by hand in 1 ms steps.
  double T = 0;
  for (double t = .075; t < 4.5; t += .001) {
    T += .001 * (20 * left(T) - T) / 2.5;
  }
  CheckEffect("thermal_friction", "temperature above ambient, K",
              at(run.log.temperature, 4.5) - 25, T, .2);
}

}  // namespace armcal::friction_physics_test
