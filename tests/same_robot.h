#pragma once

// Whether a robot that was written to a file is the same when read.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "model/inverse_dynamics.h"
#include "model/kinematics.h"
#include "model/urdf_reader.h"
#include "tests/sample_robots.h"
#include "tests/temp_file.h"

namespace armcal {

// Both robots need the same torques (1e-8 of their size) and carry the tool the
// same way, at random states.
inline void ExpectSameRobot(const Robot& a, const Robot& b) {
  ASSERT_EQ(a.num_joints(), b.num_joints());
  std::mt19937_64 random(5);
  const int n = a.num_joints();
  for (int k = 0; k < 20; ++k) {
    const Eigen::VectorXd q = UniformVector(&random, n, -3, 3);
    const Eigen::VectorXd qd = UniformVector(&random, n, -2, 2);
    const Eigen::VectorXd qdd = UniformVector(&random, n, -5, 5);
    const Eigen::VectorXd tau = InverseDynamics(a, q, qd, qdd);
    EXPECT_LE((InverseDynamics(b, q, qd, qdd) - tau).norm(), 1e-8 * tau.norm());
    EXPECT_LE((ToolPose(a, q).matrix() - ToolPose(b, q).matrix()).norm(), 1e-8);
  }
  for (int i = 0; i < n; ++i) {
    const Joint &x = a.links[i].joint, &y = b.links[i].joint;
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.type, y.type);
    EXPECT_EQ(a.links[i].name, b.links[i].name);
    EXPECT_NEAR(x.viscous, y.viscous, 1e-9);
    EXPECT_NEAR(x.coulomb, y.coulomb, 1e-9);
    EXPECT_TRUE(!std::isfinite(x.upper) || std::abs(x.upper - y.upper) < 1e-9);
  }
}

inline Robot ReadBack(const std::string& urdf, const Eigen::Vector3d& gravity) {
  RobotReaderOptions options;
  options.gravity = gravity;
  return ReadUrdf(WriteFile(urdf, "written.urdf"), options);
}

}  // namespace armcal
