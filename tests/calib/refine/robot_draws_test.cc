#include "calib/refine/robot_draws.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <map>
#include <sstream>

#include "calib/refine/robot_parameters.h"
#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/nonlinear_runs.h"

namespace armcal::robot_draws_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct State {
  VectorXd q, qd, qdd;
};

// Of the range in which a robot works, not of any log.
std::vector<State> RandomStates(int num_joints, std::mt19937_64* random) {
  std::vector<State> states(60);
  for (State& s : states) {
    for (VectorXd* x : {&s.q, &s.qd, &s.qdd}) {
      x->resize(num_joints);
      for (double& value : *x) value = Normal(random);
    }
  }
  return states;
}

// Torques of the arm's rigid links, motors' inertia and viscous friction.
VectorXd Torques(const Robot& robot, const std::vector<State>& states) {
  const int n = robot.num_joints();
  VectorXd torques(n * states.size());
  for (size_t k = 0; k < states.size(); ++k) {
    const auto& [q, qd, qdd] = states[k];
    auto tau = torques.segment(n * static_cast<Eigen::Index>(k), n);
    tau = InverseDynamics(robot, q, qd, qdd);
    for (int j = 0; j < n; ++j) {
      const Joint& joint = robot.links[j].joint;
      tau[j] += joint.armature * qdd[j] + joint.viscous * qd[j];
    }
  }
  return torques;
}

struct Drawn {
  NonlinearCalibration calibrated;
  std::vector<State> states;
  RobotDraws draws;
};

// Calibrated on a simulated log.
const Drawn& DrawnOf(const std::string& arm) {
  static std::map<std::string, Drawn> made;
  Drawn& drawn = made[arm];
  if (!drawn.draws.robots.empty()) return drawn;
  std::mt19937_64 random(4);
  drawn.calibrated =
      Calibrate(MakeArm(arm, .3, &random), .02, {}, &random).physical;
  drawn.states = RandomStates(drawn.calibrated.robot.num_joints(), &random);
  drawn.draws = DrawRobots(drawn.calibrated, 64);
  return drawn;
}

// Torques are linear in the parameters: what the covariance makes of them at
// the states, joint by joint, mean squares.
VectorXd PredictedVariance(const Drawn& made) {
  const NonlinearCalibration& c = made.calibrated;
  const VectorXd at = Torques(c.robot, made.states);
  MatrixXd Y(at.size(), c.parameters.size());
  for (size_t k = 0; k < c.parameters.size(); ++k) {
    RobotParameters more(c.robot);
    more.Set(c.parameters[k].name, c.parameters[k].value + 1);
    Y.col(static_cast<Eigen::Index>(k)) =
        Torques(more.Apply(), made.states) - at;
  }
  return (Y * c.covariance).cwiseProduct(Y).rowwise().sum();
}

double OverJoint(const VectorXd& squares, int joint, int num_joints) {
  return squares(Eigen::seqN(joint, squares.size() / num_joints, num_joints))
      .mean();
}

class RobotDrawsTest : public testing::TestWithParam<const char*> {};

TEST_P(RobotDrawsTest, CanExist) {
  const RobotDraws& draws = DrawnOf(GetParam()).draws;
  ASSERT_EQ(draws.robots.size(), 64u);
  for (const Robot& robot : draws.robots) {
    for (const Link& link : robot.links) {
      const auto P = PseudoInertia(link.inertial.ToVector());
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(P)
                    .eigenvalues()
                    .minCoeff(),
                0);
      EXPECT_GE(link.joint.viscous, 0);
      EXPECT_GE(link.joint.coulomb, 0);
      EXPECT_GE(link.joint.armature, 0);
    }
  }
}

// Within 10 % over the arm with 64 robots. Of one joint, whose torques may
// hang on a single unknown, the spread of 64 is itself known to 9 % (one
// standard deviation): 30 % are allowed.
TEST_P(RobotDrawsTest, SpreadAsThePosteriorSays) {
  const Drawn& made = DrawnOf(GetParam());
  const NonlinearCalibration& c = made.calibrated;
  const VectorXd predicted = PredictedVariance(made);
  const VectorXd at = Torques(c.robot, made.states);
  VectorXd drawn = VectorXd::Zero(at.size());
  for (const Robot& robot : made.draws.robots) {
    drawn += (Torques(robot, made.states) - at).cwiseAbs2() / 64;
  }
  const int n = c.robot.num_joints();
  double whole = 0;
  for (int j = 0; j < n; ++j) {
    const double ratio = OverJoint(drawn, j, n) / OverJoint(predicted, j, n);
    EXPECT_NEAR(std::sqrt(ratio), 1, .3) << "joint " << j;
    whole += ratio / n;
  }
  EXPECT_NEAR(std::sqrt(whole), 1, .1);
}

TEST_P(RobotDrawsTest, AreWrittenAsTheyAre) {
  const Drawn& made = DrawnOf(GetParam());
  const RobotDraws& draws = made.draws;
  std::istringstream lines(RobotDrawsCsv(draws));
  std::string header, row;
  std::getline(lines, header), std::getline(lines, row);
  EXPECT_EQ(header.substr(0, header.find(',')),
            '"' + made.calibrated.parameters[0].name + '"');
  for (size_t k = 0; k < draws.names.size(); ++k) {
    const size_t end = row.find(',');
    EXPECT_EQ(std::stod(row.substr(0, end)),
              ValueIn(draws.robots[0], draws.names[k]));
    row.erase(0, end + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, RobotDrawsTest,
                         testing::Values("3R elbow", "Panda 7R"));

}  // namespace armcal::robot_draws_test
