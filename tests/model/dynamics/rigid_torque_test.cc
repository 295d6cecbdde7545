#include "model/dynamics/rigid_torque.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/two_link_arm.h"

namespace armcal::rigid_torque_test {

// By hand from the textbook's equations: of the first joint's torque
//   d/dq1 = -(m1 lc1 + m2 l1) g sin q1 - m2 lc2 g sin(q1 + q2),
//   d/dqd1 = 2 h qd2,
// of the second's, which knows its own velocity not at all,
//   d/dq2 = -m2 l1 lc2 (sin q2 qdd1 - cos q2 qd1^2) - m2 lc2 g sin(q1 + q2).
TEST(SlopesOfLinkTorque, AreTheTextbooks) {
  const TwoLinkArm arm;
  const Trajectory at = arm.Record(.02, 200);
  Motion motion;
  motion.dt = .02;
  motion.q = at.q;
  motion.qd = at.qd;
  motion.qdd = at.qdd;
  const LinkTorqueSlopes slopes = SlopesOfLinkTorque(arm.ToRobot(), motion);
  for (int k = 0; k < motion.size(); ++k) {
    const double q1 = at.q(k, 0), q2 = at.q(k, 1), qd1 = at.qd(k, 0);
    const double coupling = arm.m2 * arm.l1 * arm.lc2;
    const double fall = arm.m2 * arm.lc2 * arm.g * std::sin(q1 + q2);
    EXPECT_NEAR(
        slopes.stiffness(k, 0),
        -(arm.m1 * arm.lc1 + arm.m2 * arm.l1) * arm.g * std::sin(q1) - fall,
        1e-7);
    EXPECT_NEAR(slopes.damping(k, 0),
                -2 * coupling * std::sin(q2) * at.qd(k, 1), 1e-11);
    EXPECT_NEAR(slopes.inertia(k, 0),
                arm.m1 * arm.lc1 * arm.lc1 +
                    arm.m2 * (arm.l1 * arm.l1 + arm.lc2 * arm.lc2) +
                    2 * coupling * std::cos(q2) + arm.I1 + arm.I2,
                1e-11);
    EXPECT_NEAR(
        slopes.stiffness(k, 1),
        coupling * (std::cos(q2) * qd1 * qd1 - std::sin(q2) * at.qdd(k, 0)) -
            fall,
        1e-7);
    EXPECT_NEAR(slopes.damping(k, 1), 0, 1e-11);
    EXPECT_NEAR(slopes.inertia(k, 1), arm.m2 * arm.lc2 * arm.lc2 + arm.I2,
                1e-11);
  }
}

}  // namespace armcal::rigid_torque_test
