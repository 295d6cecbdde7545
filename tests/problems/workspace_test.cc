#include "problems/workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/fixtures/sample_robots.h"

namespace armcal::workspace_test {

using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Links of 0.5 and 0.4 m in W's x-y plane; gravity pulls along -y.
Robot Planar() { return SampleRobot("2R planar (vertical plane)"); }

Workspace Room(const Robot& robot, const WorkspaceOptions& options) {
  const VectorXd most = VectorXd::Constant(robot.num_joints(), 3);
  return {robot, options, -most, most};
}

WorkspaceOptions Floor(double height, double radius) {
  WorkspaceOptions options;
  options.floor = height;
  options.link_radius = radius;
  return options;
}

// At rest.
Motion At(const MatrixXd& q) {
  Motion motion;
  motion.q = q;
  motion.qd = motion.qdd = 0 * q;
  return motion;
}

const RowVector2d kLevel(0, 0), kUp(M_PI / 2, 0);

TEST(Workspace, EmptyIsInNobodysWay) {
  EXPECT_TRUE(Workspace().empty());
  EXPECT_GT(Workspace().Clearance(kLevel), 1e300);
  EXPECT_TRUE(Room(Planar(), {}).empty());
}

TEST(Workspace, TheFloorIsWhereThingsFallTo) {
  Robot robot = Planar();
  EXPECT_NEAR(Room(robot, Floor(-.5, .1)).Clearance(kLevel), .4, 1e-12);
  EXPECT_NEAR(Room(robot, Floor(-.5, .1)).Clearance(-kUp), -.5, 1e-12);
  robot.gravity = -robot.gravity;
  EXPECT_NEAR(Room(robot, Floor(-.5, .1)).Clearance(kUp), -.5, 1e-12);
}

// The base's ball reaches into the floor that it stands on, in any posture.
TEST(Workspace, WhatCannotMoveIsNotHeldAgainstAnything) {
  EXPECT_GT(Room(Planar(), Floor(-.05, .1)).Clearance(kUp), 0);
}

TEST(Workspace, ObstaclesAreKeptOutOf) {
  WorkspaceOptions options;
  options.link_radius = .05;
  options.obstacles = {{{1.2, -1, -9}, {2, 1, 9}}};
  EXPECT_NEAR(Room(Planar(), options).Clearance(kLevel), .25, 1e-12);
  options.obstacles = {{{1.2, .4, -9}, {2, 1, 9}}};  // its edge
  EXPECT_NEAR(Room(Planar(), options).Clearance(kLevel), .45, 1e-12);
  options.obstacles = {{{.7, -.3, -9}, {2, .3, 9}}};  // the tool is 0.2 deep
  EXPECT_NEAR(Room(Planar(), options).Clearance(kLevel), -.25, 1e-12);
}

TEST(Workspace, TheToolsPointStaysInItsBox) {
  WorkspaceOptions options;
  options.tool_box = {{-1, -.2, -1}, {.95, .2, 1}};
  EXPECT_NEAR(Room(Planar(), options).Clearance(kLevel), .05, 1e-12);
  EXPECT_NEAR(Room(Planar(), options).Clearance(kUp), -.7, 1e-12);
}

TEST(Workspace, SaysWhatNoPostureDoes) {
  WorkspaceOptions options;
  options.tool_box = {{5, -1, -1}, {6, 1, 1}};
  try {
    Room(Planar(), options);
    FAIL() << "a tool 5 m away";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr(" in the tool's box 5:6,-1:1,-1:1"));
  }
}

TEST(Workspace, TheBarrierKnowsItsSlope) {
  for (const char* name : {"PUMA560 6R", "SCARA RRPR"}) {
    const Robot robot = SampleRobot(name);
    const int n = robot.num_joints();
    WorkspaceOptions options = Floor(-1.1, .05);
    options.tool_box = {{-1, -1.1, -1.2}, {1.1, .95, 1.3}};
    options.obstacles = {{{.9, .7, -1}, {1.5, 1.5, 1.1}}};
    const Workspace room = Room(robot, options);
    MatrixXd q(2, n);
    std::mt19937_64 random(4);
    do {
      for (double& x : q.reshaped()) x = Uniform(&random, -.6, .6);
    } while (room.Clearance(q) < .03);
    MotionGradient gradient(At(q)), unused(At(q));
    const double at = room.Barrier(q, .01, 2, &gradient);
    EXPECT_GT(at, 0);
    for (int s = 0; s < 2; ++s) {
      for (int j = 0; j < n; ++j) {
        MatrixXd more = q, less = q;
        more(s, j) += 1e-6;
        less(s, j) -= 1e-6;
        const double slope = (room.Barrier(more, .01, 0, &unused) -
                              room.Barrier(less, .01, 0, &unused)) /
                             2e-6;
        EXPECT_NEAR(gradient.q(s, j), 2 * slope, 1e-6) << name << s << j;
      }
    }
  }
}

TEST(Workspace, TheBarrierEndsAtItsMargin) {
  const Workspace room = Room(Planar(), Floor(-.15, .1));
  MotionGradient gradient(At(kLevel));
  EXPECT_TRUE(std::isfinite(room.Barrier(kLevel, .04, 1, &gradient)));
  EXPECT_TRUE(std::isinf(room.Barrier(kLevel, .06, 1, &gradient)));
}

}  // namespace armcal::workspace_test
