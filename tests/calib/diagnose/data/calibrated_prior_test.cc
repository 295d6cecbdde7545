#include "calib/diagnose/data/calibrated_prior.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <memory>
#include <random>

#include "calib/diagnose/data/baseline.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::calibrated_prior_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = BaselineColumn::Kind;

constexpr double kMassStddev = .02, kViscousStddev = .01, kArmatureStddev = .03;

// An arm of two joints whose calibration knows a mass, a friction and an
// armature that it found to be 0, and nothing else.
class CalibratedPriorTest : public testing::Test {
 protected:
  CalibratedPriorTest() : robot_(SampleRobot("2R planar (vertical plane)")) {
    SetRandomInertials(&random_, &robot_);
    for (Link& link : robot_.links) {
      link.joint.viscous = 2;
      link.joint.coulomb = 1;
    }
    ParameterPosterior posterior;
    posterior.parameters = {{1, JointTerm::kArmature},
                            {0, JointTerm::kViscous},
                            {1, std::nullopt, 0}};
    const Eigen::Vector3d stddev(kArmatureStddev, kViscousStddev, kMassStddev);
    Eigen::Matrix3d correlation;
    correlation << 1, .2, -.9, .2, 1, 0, -.9, 0, 1;
    posterior.covariance =
        stddev.asDiagonal() * correlation * stddev.asDiagonal();
    options_.posterior = std::make_shared<ParameterPosterior>(posterior);
    options_.transitions = {{CoulombTransition::Law::kVelocity, .02},
                            {CoulombTransition::Law::kDisplacement, .003}};
  }
  GapBaseline Baseline() const {
    return GapBaseline(robot_, options_, Eigen::Vector2d(10, 10));
  }
  static int Find(const GapBaseline& baseline, Kind kind, int joint,
                  int index) {
    for (int c = 0; c < baseline.size(); ++c) {
      const BaselineColumn& column = baseline.columns()[c];
      if (column.kind == kind && column.joint == joint &&
          column.index == index) {
        return c;
      }
    }
    return -1;
  }
  // Of the mass, the friction and the armature, SI units.
  MatrixXd Covariance(const GapBaseline& baseline) const {
    const std::vector<int> which = {
        Find(baseline, Kind::kInertial, 1, 0),
        Find(baseline, Kind::kTerm, 0, static_cast<int>(JointTerm::kViscous)),
        Find(baseline, Kind::kTerm, 1, static_cast<int>(JointTerm::kArmature))};
    Eigen::Vector3d unit;
    for (int k = 0; k < 3; ++k) {
      if (which[k] < 0) return {};
      unit[k] = baseline.columns()[which[k]].spread;
    }
    const MatrixXd all = baseline.prior().Precision(baseline.size()).inverse();
    EXPECT_NEAR(all.trace() - all(which, which).trace(), baseline.size() - 3,
                1e-9);
    return unit.asDiagonal() * all(which, which) * unit.asDiagonal();
  }

  std::mt19937_64 random_{5};
  Robot robot_;
  BaselineOptions options_;
};

TEST_F(CalibratedPriorTest, IsTheCalibrationsCovariance) {
  const MatrixXd covariance = Covariance(Baseline());
  ASSERT_EQ(covariance.rows(), 3);
  EXPECT_NEAR(covariance(0, 0), kMassStddev * kMassStddev, 1e-9);
  EXPECT_NEAR(covariance(1, 1), kViscousStddev * kViscousStddev, 1e-9);
  EXPECT_NEAR(covariance(2, 2), kArmatureStddev * kArmatureStddev, 1e-9);
  EXPECT_NEAR(covariance(0, 2), -.9 * kMassStddev * kArmatureStddev, 1e-9);
  EXPECT_NEAR(covariance(1, 2), .2 * kViscousStddev * kArmatureStddev, 1e-9);
  EXPECT_NEAR(covariance(0, 1), 0, 1e-9);
}

TEST_F(CalibratedPriorTest, AnotherLogMayBeFurtherOff) {
  options_.posterior_deviations = 3;
  const MatrixXd covariance = Covariance(Baseline());
  EXPECT_NEAR(covariance(0, 0), 9 * kMassStddev * kMassStddev, 1e-9);
  EXPECT_NEAR(covariance(0, 2), -9 * .9 * kMassStddev * kArmatureStddev, 1e-9);
}

// Viscous friction scatters by a tenth from day to day: .2 of 2.
TEST_F(CalibratedPriorTest, FrictionOfAnotherDayIsWider) {
  options_.of_another_day = true;
  const MatrixXd covariance = Covariance(Baseline());
  EXPECT_NEAR(covariance(0, 0), kMassStddev * kMassStddev, 1e-9);
  EXPECT_NEAR(covariance(1, 1), kViscousStddev * kViscousStddev + .2 * .2,
              1e-9);
}

// The calibrated width counts, but not one of displacement.
TEST_F(CalibratedPriorTest, FrictionChangesSignAsCalibrated) {
  const GapBaseline baseline = Baseline();
  EXPECT_EQ(baseline.transitions()[0].width, .02);
  EXPECT_EQ(baseline.transitions()[1].width, 6e-3);
  EXPECT_EQ(baseline.transitions()[1].law, CoulombTransition::Law::kVelocity);
  options_.transitions[0].width = 1e-6;
  EXPECT_EQ(Baseline().transitions()[0].width, 1.5e-3);
}

TEST_F(CalibratedPriorTest, StaysAboutTheCalibratedRobotWhenThatMoves) {
  const GapBaseline baseline = Baseline();
  const int mass = Find(baseline, Kind::kInertial, 1, 0);
  const VectorXd x = 3 * VectorXd::Unit(baseline.size(), mass);
  const GapBaseline moved = baseline.MovedTo(x);
  EXPECT_NEAR(moved.prior().Residual(-x).norm(), 0, 1e-9);
  EXPECT_NEAR(moved.prior().Residual(0 * x).norm(),
              baseline.prior().Residual(x).norm(), 1e-9);
  EXPECT_GT(baseline.prior().Residual(x).norm(), 1);
}

}  // namespace armcal::calibrated_prior_test
