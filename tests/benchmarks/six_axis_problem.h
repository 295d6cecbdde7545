#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/robot/robot.h"
#include "tests/benchmarks/six_axis_torque.h"

namespace armcal {

// A calibration that Ceres and armcal both solve: 60 inertial and 24 geometric
// parameters (modified DH rows a, alpha, d, theta) of a 6R arm of a UR10e's
// size, from torques with noise at states that have nothing to do with each
// other. A prior holds the parameters near the truth.
struct SixAxisProblem {
  static constexpr int kJoints = 6, kInertial = 60, kGeometric = 24;
  static constexpr double kInertialPrior = 10, kGeometricPrior = 200;

  explicit SixAxisProblem(int num_samples);

  Robot MakeRobot() const;

  std::vector<double> inertial, geometric;
  std::vector<SixAxisSample> samples;
};

}  // namespace armcal
