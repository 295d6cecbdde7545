#pragma once

// A simulated arm whose geometry and links differ from its file's, with a log
// of its torques and poses that an instrument measures.

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/fixtures/nonlinear_runs.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal {

struct BentArm {
  static constexpr double kLength = 2e-3, kAngle = .2 * M_PI / 180;
  static constexpr double kInertia = .05;
  static constexpr CoulombTransition kWidth = {
      CoulombTransition::Law::kVelocity, .03};

  BentArm(const std::string& arm_name, std::uint64_t seed);

  // Without noise.
  Log Move(double duration, double dt);
  static void SetTorque(const Robot& robot, Log* log);
  // Torque noise of 1 %, encoders of 2e-5 rad.
  std::string Record(double duration);
  PoseMeasurements Measure(Instrument instrument, int poses, double noise);
  double ValueOf(const PhysicalParameter& p) const;

  std::mt19937_64 random;
  std::string name;
  Robot file, truth;
  std::vector<std::string> names;  // of the geometry
  Eigen::VectorXd g;
};

// The rms distance, m, of the tools of two robots over 200 positions, when the
// frames that they are seen in are brought together.
double ToolError(const Robot& a, const Robot& b);

// The rms of the torque's deviation over the torque's, %, mean over joints.
double TorqueError(const Robot& robot, const Log& exact);

}  // namespace armcal
