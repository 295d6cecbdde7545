// What simulated logs show of bodies, links and the base: a table of effect,
// what is measured, its value in the log, its value by hand. And that every
// effect is in one of the tables.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/model/plant/hidden/hidden_runs.h"

namespace armcal::body_physics_long_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

TEST(HiddenBodyPhysics, Inertia) {
  HiddenLoop loop(Wheel(), Sine(.3, 1, 4));
  const auto size = [](const HiddenRun& run) {
    return Line(run, run.log.tau.col(0), 1, 1).norm() /
           Line(run, run.log.q.col(0), 1, 1).norm() / std::pow(2 * M_PI, 2);
  };
  EXPECT_NEAR(size(loop.Without()), kInertia + kMotor, .003);
  CheckEffect("armature", "torque over acceleration, kg m^2 more",
              size(loop.Run("armature", 0, {.5})) - kInertia - kMotor, .3,
              .003);
  CheckEffect("link_inertia", "torque over acceleration, link's share",
              (size(loop.Run("link_inertia", 0, {.2})) - kMotor) / kInertia,
              1.2, .005);
}

TEST(HiddenBodyPhysics, Weight) {
  const HiddenLoop loop(Pendulum(), Hold(2));
  const auto held = [](const HiddenRun& run) { return run.Torque(1, 2); };
  CheckEffect("link_inertia", "torque held over the weight's",
              held(loop.Run("link_inertia", 0, {-.2})) / kWeight, .8, .001);
  // 0.4 kg at the tool 0.5 m out and 0.1 m beyond it.
  CheckEffect("payload", "torque held, less the link's",
              held(loop.Run("payload", -1, {.1, .1, 0, 0})) - kWeight,
              .1 * kMass * kGravity * .6, .005);

  HiddenLoop two(EasyRobot({EasyLink("a", Axis::kLevel),
                            EasyLink("b", Axis::kUpright, .4)}),
                 Hold(2));
  const HiddenRun longer = two.Run("link_length", 0, {.05});
  CheckEffect("link_length", "shoulder's torque: next link further out",
              longer.Torque(1, 2) - two.Without().Torque(1, 2),
              kMass * kGravity * .05, .005);
  CheckEffect("link_length", "the next joint's own",
              longer.Torque(1, 2, 1) - two.Without().Torque(1, 2, 1), 0, .005);

  HiddenLoop turn(Wheel(), Plateaus({1.5, -1.5}, 4.1));
  const HiddenRun tilted = turn.Run("base_tilt", -1, {.05, 1});
  const int n = 1900;
  const VectorXd q = tilted.log.q.col(0).segment(150, n);
  MatrixXd waves(n, 2);
  waves << q.array().cos().matrix(), q.array().sin().matrix();
  const VectorXd tau =
      (tilted.log.tau - turn.Without().log.tau).col(0).segment(150, n);
  CheckEffect("base_tilt", "once per turn: the weight across the axis",
              waves.colPivHouseholderQr().solve(tau).norm(),
              kWeight * std::sin(.05), .005);
}

TEST(HiddenBodyPhysics, Contact) {
  HiddenLoop loop(Pendulum(), Hold(4));
  loop.context.seed = 3;
  const HiddenRun run = loop.Run("external_contact", -1, {.2, .5, .5});
  const double lift = run.Value("force_z") * .5;  // 0.5 m out
  EXPECT_GT(std::abs(lift), .5);
  CheckEffect("external_contact", "torque's change at its time, held level",
              run.Torque(1.98, 2.02) - kWeight, -lift, .02 * std::abs(lift));
  // sech^2(2) = 0.0707.
  CheckEffect("external_contact", "the same two widths later",
              run.Torque(2.98, 3.02) - kWeight, -.0707 * lift,
              .02 * std::abs(lift));
}

// After a stop the arm stands still, the load does not.
TEST(HiddenBodyPhysics, SloshAndMountRing) {
  HiddenLoop loop(Pendulum(), Plateaus({1, -1, 0, 0, 0}, .5));
  loop.bandwidth_hz = 30;  // stiff against what rings
  const VectorXd still = loop.Without().log.tau.col(0);
  HiddenRun run = loop.Run("slosh", -1, {.05, 3, .02});
  const double stop = 1.6;  // s
  CheckEffect("slosh", "frequency after the stop, Hz",
              LoudestLine(run, run.log.tau.col(0), 1.5, 8, stop), 3, .05);
  EXPECT_GT(Line(run, run.log.tau.col(0), 3, stop).norm(), .05);
  EXPECT_LT(Line(run, still, 3, stop).norm(), .005);

  run = loop.Run("mount_resonance", -1, {4, .02});
  // About y: the pendulum and a plate like the rod of 0.6 m.
  const double inertia = kInertia + kMass * .36 / 3;
  // The joint's loop gives way under half of it by k / K = 0.03: at most 0.7 %.
  const double f = std::sqrt(run.Value("stiffness") / inertia) / (2 * M_PI);
  CheckEffect("mount_resonance", "frequency after the stop, Hz",
              LoudestLine(run, run.log.tau.col(0), 1.5, 8, stop), f, .04);
  EXPECT_LT(Line(run, still, f, stop).norm(),
            .1 * Line(run, run.log.tau.col(0), f, stop).norm());
}

// Panning at w pushes the tilt joint by w times the flywheel's share along the
// link; centrifugal torque is the same both ways.
TEST(HiddenBodyPhysics, Gyroscope) {
  HiddenLoop loop(
      EasyRobot({EasyLink("a", Axis::kUpright), EasyLink("b", Axis::kLevel)}),
      Plateaus({1, -1}, .8));
  const auto odd = [](const HiddenRun& run) {
    return (run.Torque(.6, .9, 1) - run.Torque(1.6, 1.85, 1)) / 2;
  };
  EXPECT_NEAR(odd(loop.Without()), 0, .002);
  const HiddenRun run = loop.Run("gyroscope", 1, {.3});
  EXPECT_GT(std::abs(run.Value("momentum_x")), .3);
  // On the link: H x w, w along its y (up), about its z.
  CheckEffect("gyroscope", "tilt torque, odd part in the pan velocity",
              odd(run), -run.Value("momentum_x"), .01);
}

// A fixed weight's torque changes its sign when the link turns over; that of a
// weight which slides to the low side does not.
TEST(HiddenBodyPhysics, LooseBolt) {
  const auto held = [](double q, double* even) {
    HiddenLoop loop(Pendulum(), Hold(1.5));
    loop.q0[0] = q;
    loop.context.seed = 2;
    const HiddenRun run = loop.Run("loose_bolt", 0, {.2});
    *even += run.Torque(1, 1.5) / 2;
    return run;
  };
  double even = 0;
  const HiddenRun run = held(1, &even);
  held(1 + M_PI, &even);
  // The link's axes level and up: x out and up by q, y across it.
  const double q = 1, ux = run.Value("axis_x"), uy = run.Value("axis_y");
  const double out = ux * std::cos(q) - uy * std::sin(q);
  const double up = ux * std::sin(q) + uy * std::cos(q);
  const double slid = -up / std::hypot(up, .1);
  EXPECT_GT(std::abs(2 * slid * out), .2);
  // Its weight times how far out it slid.
  CheckEffect("loose_bolt", "torque's even part under turning over", even,
              2 * slid * out, .005);
}

// A table without an effect would say nothing of it.
TEST(HiddenPhysics, TablesHaveEveryEffect) {
  std::string tables;
  for (const std::string family :
       {"friction_physics", "drive_physics", "torque_physics_long",
        "body_physics_long"}) {
    std::ifstream file(std::string(TESTS_DIR) + "/model/plant/hidden/" +
                       family + "_test.cc");
    ASSERT_TRUE(file) << family;
    std::stringstream text;
    text << file.rdbuf();
    tables += text.str();
  }
  for (const HiddenEffect& effect : HiddenEffects()) {
    EXPECT_NE(tables.find("CheckEffect(\"" + effect.name + "\""),
              std::string::npos)
        << effect.name;
  }
}

}  // namespace armcal::body_physics_long_test
