#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/plant/hidden/hidden_plant.h"

namespace armcal::wrenches_test {

using Eigen::Vector3d;
using Eigen::VectorXd;

PointInstant Somewhere() {
  PointInstant at;
  at.X_WP = Eigen::AngleAxisd(.7, Vector3d(1, 2, 2) / 3) *
            Eigen::Translation3d(.1, .2, .3);
  at.w_WP = Vector3d(.5, -1, 2);
  at.v_WP = Vector3d(-.3, .4, .1);
  return at;
}

TEST(HiddenWrenches, APushSwellsAndFades) {
  const HiddenPlant plant("external_contact", -1, {.05, .5, .4});
  const WrenchLaw& law = plant.robot.wrenches[0];
  EXPECT_EQ(law.attachment.link, 5);
  PointInstant at = Somewhere();
  at.t = 20;
  const Vector3d peak = law.wrench(at, nullptr, nullptr).force;
  EXPECT_NEAR(peak.norm(), plant.Value("force"), 1e-12);
  EXPECT_NEAR(peak.y(), plant.Value("force_y"), 1e-12);
  // sech^2(1) = 0.41997, to both sides.
  for (const double t : {19.6, 20.4}) {
    at.t = t;
    EXPECT_LT((law.wrench(at, nullptr, nullptr).force - .41997 * peak).norm(),
              1e-4 * peak.norm());
  }
  at.t = 25;
  EXPECT_LT(law.wrench(at, nullptr, nullptr).force.norm(), 1e-9 * peak.norm());
}

// At rest the load hangs in its spring and only weighs; its own swing has its
// frequency; on a shaken tool it takes power from nowhere.
TEST(HiddenWrenches, SloshHangsAndSwings) {
  const HiddenPlant plant("slosh", -1, {.05, 2, .05});
  const WrenchLaw& law = plant.robot.wrenches[0];
  const double m = plant.Value("mass"), omega = 2 * M_PI * 2;
  PointInstant at = Somewhere();
  at.w_WP = at.v_WP = Vector3d::Zero();
  VectorXd state = law.initial_state(at.X_WP), rate(6);
  const Vector3d weight(0, 0, -9.81 * m);
  EXPECT_LT((law.wrench(at, state.data(), rate.data()).force - weight).norm(),
            1e-9);
  EXPECT_LT(rate.norm(), 1e-9);
  state[0] += .01;
  state[4] = .2;
  at.v_WP.y() = .05;
  const Vector3d force = law.wrench(at, state.data(), rate.data()).force;
  EXPECT_NEAR(rate[3], -omega * omega * .01, 1e-9);
  EXPECT_NEAR(rate[4], -2 * .05 * omega * (.2 - .05), 1e-9);
  EXPECT_EQ(rate[1], .2);
  // What it feels it gives: m a = m g - force.
  EXPECT_LT((m * rate.tail<3>() - (weight - force)).norm(), 1e-9);
}

TEST(HiddenWrenches, GyroscopePushesAcrossWithoutPower) {
  const HiddenPlant plant("gyroscope", 2, {.1});
  const WrenchLaw& law = plant.robot.wrenches[0];
  EXPECT_EQ(law.attachment.link, 2);
  PointInstant at = Somewhere();
  const Wrench wrench = law.wrench(at, nullptr, nullptr);
  EXPECT_EQ(wrench.force.norm(), 0);
  EXPECT_GT(wrench.moment.norm(), .05);
  EXPECT_LE(wrench.moment.norm(), 1 * at.w_WP.norm());
  EXPECT_NEAR(wrench.moment.dot(at.w_WP), 0, 1e-12);
  // dH/dt = w x H is what the link has to give: twice the rate, twice as much.
  at.w_WP *= 2;
  EXPECT_LT(
      (law.wrench(at, nullptr, nullptr).moment - 2 * wrench.moment).norm(),
      1e-12);
}

// Turning the link over turns the moment of a weight that slid across: it keeps
// pulling to the same side of the world, where a fixed weight would reverse.
TEST(HiddenWrenches, LooseWeightSlidesToTheLowSide) {
  const HiddenPlant plant("loose_bolt", 2, {.1});
  const WrenchLaw& law = plant.robot.wrenches[0];
  std::mt19937_64 random(5);
  double largest = 0;
  for (int k = 0; k < 300; ++k) {
    PointInstant at;
    const Eigen::Vector4d turn = UniformVector(&random, 4, -1, 1);
    at.X_WP.linear() = Eigen::Quaterniond(turn).normalized().toRotationMatrix();
    const Vector3d moment = law.wrench(at, nullptr, nullptr).moment;
    EXPECT_NEAR(moment.z(), 0, 1e-12);  // of a weight
    largest = std::max(largest, moment.norm());
    // Turned over in its axis' own plane with gravity.
    PointInstant over = at;
    over.X_WP.linear() =
        Eigen::AngleAxisd(M_PI, Vector3d::UnitZ()) * at.X_WP.linear();
    EXPECT_LT((law.wrench(over, nullptr, nullptr).moment + moment).norm(),
              1e-9);
    over.X_WP.linear() = -at.X_WP.linear();  // u to -u
    EXPECT_LT((law.wrench(over, nullptr, nullptr).moment - moment).norm(),
              1e-9);
  }
  // The largest of c / sqrt(c^2 + a^2) sqrt(1 - c^2), a = 0.1.
  EXPECT_NEAR(largest, 1 / (.1 + std::sqrt(1.01)), .001);
}

}  // namespace armcal::wrenches_test
