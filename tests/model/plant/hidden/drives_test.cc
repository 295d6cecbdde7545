#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tests/model/plant/hidden/hidden_plant.h"

namespace armcal::drives_test {

using Eigen::VectorXd;

VectorXd Command(double of_joint_1) {
  VectorXd torque(6);
  torque << 1, of_joint_1, 3, 4, 5, 6;
  return torque;
}
// Given to joint 1; the others get what they were promised.
double Given(const HiddenPlant& plant, double command) {
  const VectorXd given = plant.Given(Command(command));
  VectorXd others = given - Command(command);
  others[1] = 0;
  EXPECT_EQ(others.norm(), 0);
  return given[1];
}

TEST(HiddenDrives, AmplifiersByHand) {
  EXPECT_EQ(Given({"torque_offset", 1, {-.1}}, 7), 8);
  EXPECT_NEAR(Given({"torque_gain", 1, {.1}}, 11), 10, 1e-12);
  EXPECT_NEAR(Given({"torque_nonlinearity", 1, {.1}}, 20), 18, 1e-12);
  EXPECT_NEAR(Given({"torque_nonlinearity", 1, {.1}}, -2), -2, .005);
  const HiddenPlant limited("torque_saturation", 1, {1.5, 0});
  EXPECT_NEAR(Given(limited, 5), 5, 1e-5);
  EXPECT_NEAR(Given(limited, -15), -14.158, 1e-3);  // 15 / 2^(1/12)
  EXPECT_NEAR(Given(limited, 60), 15, 1e-6);
  // Of a motor that turns at twice the speed scale: 15 (1 - .5 (2 - 1)) along
  // its torque, 15 (1 - .5 (-2 - 1)) against it, all but none at 5.
  HiddenPlant falling("torque_saturation", 1, {1.5, .5});
  EXPECT_NEAR(falling.Value("limit"), 22.5, 1e-12);
  EXPECT_NEAR(falling.Value("limit_slope"), 7.5, 1e-12);
  falling.at.velocity[1] = 2;
  EXPECT_NEAR(Given(falling, 90), 7.5, 1e-6);
  EXPECT_NEAR(Given(falling, -900), -37.5, 1e-6);
  falling.at.velocity[1] = 5;
  EXPECT_NEAR(Given(falling, 90), .15, 1e-6);
  const HiddenPlant dead("torque_deadband", 1, {.05});
  EXPECT_EQ(Given(dead, 0), 0);
  EXPECT_LT(std::abs(Given(dead, .05)), .001);
  EXPECT_NEAR(Given(dead, -.5), -.5 * (1 - 1 / std::sqrt(2)), 1e-12);
  EXPECT_NEAR(Given(dead, 20), 19.5, 1e-3);
}

// More command never gives less torque: else a controller would hang.
TEST(HiddenDrives, AmplifiersAreMonotone) {
  std::mt19937_64 random(3);
  for (const std::string name :
       {"torque_offset", "torque_gain", "torque_nonlinearity",
        "torque_saturation", "torque_deadband"}) {
    for (int draw = 0; draw < 50; ++draw) {
      HiddenPlant plant;
      ApplyHiddenEffect(*FindHiddenEffect(name), &plant.robot, 1,
                        DrawParameters(*FindHiddenEffect(name), &random),
                        plant.context);
      for (double tau = -60; tau < 60; tau += .5) {
        EXPECT_GT(Given(plant, tau + .5), Given(plant, tau) - 1e-6) << name;
      }
    }
  }
}

// The response of an actuator map to exp(i w t): its rates give A and b of
// x' = A x + b u, y = C x + D u.
std::complex<double> Response(const HiddenPlant& plant, int from, int to,
                              double omega) {
  const int n = static_cast<int>(plant.robot.actuators[0].initial_state.size());
  Eigen::MatrixXcd A(n, n);
  Eigen::VectorXcd b(n);
  Eigen::RowVectorXcd C(n);
  VectorXd x = VectorXd::Zero(n), rate(n);
  const VectorXd none = VectorXd::Zero(6);
  for (int k = 0; k < n; ++k) {
    x[k] = 1;
    C[k] = plant.Given(none, x.data(), rate.data())[to];
    A.col(k) = rate.cast<std::complex<double>>();
    x[k] = 0;
  }
  const double D =
      plant.Given(VectorXd::Unit(6, from), x.data(), rate.data())[to];
  b = rate.cast<std::complex<double>>();
  const std::complex<double> s(0, omega);
  const Eigen::MatrixXcd I = Eigen::MatrixXcd::Identity(n, n);
  return (C * (s * I - A).lu().solve(b))(0) + D;
}

TEST(HiddenDrives, DelayIsLateAndKeepsSlowTorques) {
  const HiddenPlant plant("delay", -1, {.006});
  for (int j = 0; j < 6; ++j) {
    const auto slow = Response(plant, j, j, 2);
    EXPECT_NEAR(std::abs(slow), 1, 1e-4);
    EXPECT_NEAR(-std::arg(slow) / 2, .006, 1e-6);
    EXPECT_NEAR(std::abs(Response(plant, j, j, 2 / .006)), .5, 1e-12);
    EXPECT_EQ(std::abs(Response(plant, j, (j + 1) % 6, 2)), 0);
  }
}

TEST(HiddenDrives, CrosstalkTakesTheNeighboursShare) {
  HiddenPlant plant;
  plant.context.torque[2] = 5;
  plant.Add("torque_crosstalk", 1, {.1});
  EXPECT_EQ(plant.Value("neighbour"), 3);
  EXPECT_NEAR(plant.Value("gain"), .2, 1e-12);
  EXPECT_NEAR(std::abs(Response(plant, 2, 1, 1e-3) + .2), 0, 1e-5);
  EXPECT_NEAR(-std::arg(-Response(plant, 2, 1, 5)) / 5, .003, 1e-5);
  EXPECT_NEAR(std::abs(Response(plant, 1, 1, 5) - 1.), 0, 1e-12);
  EXPECT_EQ(std::abs(Response(plant, 1, 2, 5)), 0);
}

// Six joints at 10 N m and 1 rad/s take 60 W: the sag has half its size there.
TEST(HiddenDrives, SupplySagsWithPower) {
  HiddenPlant plant("supply_sag", -1, {.2});
  plant.at.velocity << 1, -1, 1, 1, -1, 1;
  double power = 0, rate = 0;
  plant.Given(VectorXd::Constant(6, 10), &power, &rate);
  EXPECT_NEAR(rate, 60 / .05, 1e-9);
  power = 60;
  const VectorXd given = plant.Given(VectorXd::Constant(6, 10), &power, &rate);
  EXPECT_NEAR((given - VectorXd::Constant(6, 9)).norm(), 0, 1e-12);
  EXPECT_NEAR(rate, 0, 1e-9);
}

TEST(HiddenDrives, MagnetsWeakenAsTheyWarm) {
  const HiddenPlant plant("warming_motor", 1, {.1});
  double heat = 0, rate = 0;
  EXPECT_EQ(plant.Given(Command(10), &heat, &rate)[1], 10);
  EXPECT_NEAR(rate, 1. / 10, 1e-12);  // a quarter of 40 s
  heat = 1;
  EXPECT_NEAR(plant.Given(Command(10), &heat, &rate)[1], 9, 1e-12);
  EXPECT_NEAR(rate, 0, 1e-12);
}

}  // namespace armcal::drives_test
