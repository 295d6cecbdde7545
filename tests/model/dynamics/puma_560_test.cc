// The PUMA 560 of Corke and Armstrong-Helouvry ("A search for consensus among
// model parameters reported for the PUMA 560 robot", ICRA 1994), and what the
// Robotics Toolbox prints of it at its pose qn.

#include <gtest/gtest.h>

#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::puma_560_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;
constexpr double kPrinted = 5e-5;  // half of the last digit

struct Row {
  double mass;
  Vector3d com, inertia;
  // Of the motor: inertia, gear ratio, viscous and Coulomb friction forwards.
  double Jm, G, B, Tc;
};

class Puma560 : public testing::Test {
 protected:
  Puma560() : robot_(SampleRobot("PUMA560 6R")) {
    const Row rows[] = {
        {0, {0, 0, 0}, {0, .35, 0}, 200e-6, 62.6111, 1.48e-3, .395},
        {17.4,
         {-.3638, .006, .2275},
         {.13, .524, .539},
         200e-6,
         107.815,
         .817e-3,
         .126},
        {4.8,
         {-.0203, -.0141, .07},
         {.066, .086, .0125},
         200e-6,
         53.7063,
         1.38e-3,
         .132},
        {.82,
         {0, .019, 0},
         {1.8e-3, 1.3e-3, 1.8e-3},
         33e-6,
         76.0364,
         71.2e-6,
         11.2e-3},
        {.34,
         {0, 0, 0},
         {.3e-3, .4e-3, .3e-3},
         33e-6,
         71.923,
         82.6e-6,
         9.26e-3},
        {.09,
         {0, 0, .032},
         {.15e-3, .15e-3, .04e-3},
         33e-6,
         76.686,
         36.7e-6,
         3.96e-3}};
    for (int i = 0; i < 6; ++i) {
      const Row& row = rows[i];
      Link& link = robot_.links[i];
      link.inertial = InertialParameters::FromCenterOfMass(
          row.mass, row.com, row.inertia.asDiagonal());
      link.joint.armature = armature_[i] = row.Jm * row.G * row.G;
      viscous_[i] = row.B * row.G * row.G;
      coulomb_[i] = row.Tc * row.G;
    }
  }

  // Friction forwards, where the joints move.
  VectorXd Friction(const VectorXd& qd) const {
    return viscous_.cwiseProduct(qd) + coulomb_.cwiseProduct(qd.cwiseSign());
  }
  VectorXd Torque(const VectorXd& qd, const VectorXd& qdd) const {
    return InverseDynamics(robot_, qn_, qd, qdd) + armature_.cwiseProduct(qdd) +
           Friction(qd);
  }

  static VectorXd V(std::initializer_list<double> values) {
    return VectorXd::Map(values.begin(),
                         static_cast<Eigen::Index>(values.size()));
  }
  static void ExpectPrinted(const MatrixXd& found, const MatrixXd& printed,
                            double tolerance = kPrinted) {
    EXPECT_LT((found - printed).cwiseAbs().maxCoeff(), tolerance) << found;
  }

  Robot robot_;
  VectorXd armature_ = VectorXd(6), viscous_ = armature_, coulomb_ = armature_;
  const VectorXd qn_ = V({0, kPi / 4, kPi, 0, kPi / 4, 0});
  const VectorXd zero_ = VectorXd::Zero(6), one_ = VectorXd::Ones(6);
};

TEST_F(Puma560, TorquesOfGravityInertiaVelocityAndMotors) {
  ExpectPrinted(Torque(zero_, zero_), V({0, 31.6399, 6.0351, 0, .0283, 0}));
  ExpectPrinted(Torque(zero_, one_),
                V({3.35311, 36.0025, 7.42596, .190043, .203441, .194133}));
  ExpectPrinted(Torque(one_, zero_),
                V({29.1421, 56.5044, 16.3528, 1.26448, 1.12392, .519648}));
  ExpectPrinted(Torque(one_, one_),
                V({32.4952, 60.867, 17.7436, 1.45452, 1.29911, .713781}));
  robot_.gravity.setZero();
  ExpectPrinted(Torque(one_, one_),
                V({32.4952, 29.2271, 11.7085, 1.45452, 1.27086, .713781}));
}

TEST_F(Puma560, MassMatrix) {
  MatrixXd printed(6, 6);
  printed << 3.6594, -.4044, .1006, -.0025, 0, 0,  //
      -.4044, 4.4137, .3509, 0, .0024, 0,          //
      .1006, .3509, .9378, 0, .0015, 0,            //
      -.0025, 0, 0, .1925, 0, 0,                   //
      0, .0024, .0015, 0, .1713, 0,                //
      0, 0, 0, 0, 0, .1941;
  ExpectPrinted(MassMatrix(robot_, qn_) + MatrixXd(armature_.asDiagonal()),
                printed);
}

TEST_F(Puma560, Accelerations) {
  const VectorXd qd = V({.1, .2, .8, .2, .5, 1});
  const VectorXd tau = V({1, 3.2, 1.8, .1, .7, 4.6});
  ExpectPrinted(ForwardDynamics(robot_, qn_, qd, tau - Friction(qd)),
                V({-7.4102, -9.8432, -10.9694, -4.4314, -.9881, 21.0228}));
}

}  // namespace armcal::puma_560_test
