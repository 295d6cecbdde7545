#include "calib/diagnose/candidates/line_of_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace armcal::line_of_motion_test {

using Eigen::VectorXd;

constexpr double kStep = .004, kBandwidth = 10;  // s, Hz
constexpr int kSize = 5000;                      // samples: 20 s
constexpr double kInertia = 2;                   // kg m^2
constexpr double kLine = .9, kAmplitude = .1;    // Hz, rad, of the motion

// An inertia about a vertical axis that turns to and fro by kAmplitude at
// kLine, with the torque for that and a sine of `amplitude` and `frequency`.
bool IsOfMotion(double amplitude, double frequency) {
  Robot robot;
  robot.links.resize(1);
  robot.links[0].inertial = {0, Eigen::Vector3d::Zero(),
                             kInertia * Eigen::Matrix3d::Identity()};
  GapSegment segment;
  Motion& motion = segment.motion;
  motion.dt = kStep;
  const double omega = 2 * M_PI * kLine;
  const VectorXd t = VectorXd::LinSpaced(kSize, 0, kStep * (kSize - 1));
  motion.q = kAmplitude * (omega * t).array().sin();
  motion.qd = kAmplitude * omega * (omega * t).array().cos();
  motion.qdd = -omega * omega * motion.q;
  const VectorXd swing = amplitude * (2 * M_PI * frequency * t).array().cos();
  segment.tau = kInertia * motion.qdd + swing;
  segment.still.setConstant(kSize, 1, false);
  segment.still.topRows(kSize / 10).setConstant(true);  // asked nothing there
  const std::vector<GapSegment> segments = {segment};
  GapRows rows(segments, kBandwidth);
  rows.SetNoise(std::vector<Autoregression>(1),
                Eigen::MatrixXd::Zero(rows.num_thin(), 1));
  const VectorXd thin = rows.ThinAll({swing});
  return IsLineOfMotion(robot, rows, 0, -1, thin, frequency);
}

// The inertia's torque has 2 kg m^2 .1 rad (2 pi .9 Hz)^2 = 6.4 N m there.
TEST(LineOfMotion, WhereAPartOfThatWouldExplainIt) {
  EXPECT_TRUE(IsOfMotion(1, kLine));
  EXPECT_TRUE(IsOfMotion(6, kLine));
  EXPECT_FALSE(IsOfMotion(7, kLine));
  EXPECT_FALSE(IsOfMotion(1, 3.1));
}

}  // namespace armcal::line_of_motion_test
