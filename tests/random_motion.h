#pragma once

#include <Eigen/Geometry>

#include "model/motion_columns.h"
#include "tests/sample_robots.h"

namespace armcal {

// Numbers of samples that fill lanes, and that do not.
constexpr int kCounts[] = {1, 7, 8, 257};

// Samples that have nothing to do with each other.
struct RandomMotion {
  RandomMotion(std::mt19937_64* random, int count, int n, int num_coulomb)
      : q(Random(random, count, n, 3)),
        qd(Random(random, count, n, 2)),
        qdd(Random(random, count, n, 5)),
        coulomb(Random(random, count, num_coulomb, 1)) {}
  static Eigen::MatrixXd Random(std::mt19937_64* random, int rows, int cols,
                                double range) {
    Eigen::MatrixXd x(rows, cols);
    for (int j = 0; j < cols; ++j) {
      x.col(j) = UniformVector(random, rows, -range, range);
    }
    return x;
  }
  MotionColumns columns() const { return {q, qd, qdd, coulomb}; }
  Eigen::MatrixXd q, qd, qdd, coulomb;
};

inline Eigen::Isometry3d RandomPose(std::mt19937_64* random) {
  Eigen::Isometry3d X(RotationFromRpy(UniformVector(random, 3, -3, 3)));
  X.translation() = UniformVector(random, 3, -1, 1);
  return X;
}

// Joints anywhere, along the z axes of their links' frames, along others of
// them, or anyhow.
inline Robot ArmWithFrames(int n, int trial, std::mt19937_64* random) {
  Robot robot = RandomArm(n, random);
  SetRandomInertials(random, &robot);
  for (Link& link : robot.links) {
    link.X_PF = RandomPose(random);
    link.X_ML.setIdentity();
    if (trial % 3 == 1) {
      const double roll = trial % 2 * M_PI_2;
      link.X_ML.linear() = RotationFromRpy({roll, M_PI_2, 0});
    }
    if (trial % 3 == 2) link.X_ML = RandomPose(random);
  }
  return robot;
}

}  // namespace armcal
