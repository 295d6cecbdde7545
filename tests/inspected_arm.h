#pragma once

#include <random>

#include "model/log.h"
#include "model/robot.h"
#include "tests/sample_motion.h"
#include "tests/sample_robots.h"

namespace armcal {

// A known arm with friction, and a log of it at 100 Hz with noise of 1 % of
// each joint's torque.
struct InspectedArm {
  explicit InspectedArm(const char* name = "PUMA560 6R", double duration = 20) {
    std::mt19937_64 random(7);
    robot = SampleRobot(name);
    SetRandomInertials(&random, &robot);
    const int n = robot.num_joints();
    for (int j = 0; j < n; ++j) {
      Link& link = robot.links[j];
      link.has_inertial = true;
      link.name = "link" + std::to_string(j + 1);
      link.joint.name = "joint" + std::to_string(j + 1);
      link.joint.viscous = 1;
    }
    log = RecordMotion(RandomMultisine(&random, n), duration, .01);
    AddTorque(robot, &log);
    for (int j = 0; j < n; ++j) {
      AddCoulomb(j, 2, {CoulombTransition::Law::kVelocity, .02}, &log);
    }
    AddNoise(&random, .01 * ColumnRms(log.tau), &log.tau);
  }

  Robot robot;
  Log log;
};

}  // namespace armcal
