#include "tests/benchmarks/six_axis_problem.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace armcal {

SixAxisProblem::SixAxisProblem(int num_samples)
    : inertial(kInertial),
      geometric{0,   0,         .181,  0, 0,   -M_PI / 2, .176, -M_PI / 2,
                .61, 0,         -.137, 0, .57, 0,         .02,  -M_PI / 2,
                0,   -M_PI / 2, .12,   0, 0,   M_PI / 2,  .117, 0},
      samples(num_samples) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  const double masses[] = {7.4, 13, 4, 2, 2, .6};
  for (int i = 0; i < kJoints; ++i) {
    const double m = masses[i], I = .02 * m;
    const double link[] = {m,
                           .1 * m * u(random),
                           .1 * m * u(random),
                           .1 * m,
                           1.2 * I,
                           .1 * I,
                           1.3 * I,
                           .1 * I,
                           .1 * I,
                           1.1 * I};
    std::copy(link, link + 10, &inertial[10 * i]);
  }
  std::normal_distribution<double> noise(0, .5);
  for (SixAxisSample& sample : samples) {
    for (int j = 0; j < kJoints; ++j) {
      sample.q[j] = 3 * u(random);
      sample.qd[j] = 2 * u(random);
      sample.qdd[j] = 5 * u(random);
    }
    SixAxisTorque<double>().Evaluate(inertial.data(), geometric.data(), sample,
                                     sample.tau);
    for (double& tau : sample.tau) tau += noise(random);
  }
}

Robot SixAxisProblem::MakeRobot() const {
  Robot robot;
  robot.gravity = {0, 0, -9.81};
  robot.dh_convention = DhConvention::kModified;
  for (int i = 0; i < kJoints; ++i) {
    Link link;
    link.name = "link" + std::to_string(i + 1);
    const double* row = &geometric[4 * i];
    SetDhPose({row[0], row[2], row[1], row[3]}, DhConvention::kModified, &link);
    link.inertial = InertialParameters::FromVector(
        Eigen::Map<const Vector10d>(&inertial[10 * i]));
    robot.links.push_back(link);
  }
  return robot;
}

}  // namespace armcal
