#pragma once

#include <cmath>
#include <random>
#include <string>

#include "model/arm_geometry.h"
#include "model/kinematics.h"
#include "model/pose_reader.h"
#include "tests/sample_motion.h"
#include "tests/sample_robots.h"

namespace armcal {

enum class Instrument { kTargets, kPoses, kWire };
inline constexpr double kNoise = 5e-5;    // m
inline constexpr double kAngular = 1e-4;  // rad

// A robot that differs from its file by 2 mm and 0.2 degrees in every
// parameter, before an instrument.
struct Plant {
  explicit Plant(const std::string& name, std::uint64_t seed) : random(seed) {
    nominal = SampleRobot(name);
    ArmGeometry geometry(nominal);
    truth = geometry.Values();
    for (int k = 6; k + 6 < geometry.size(); ++k) {
      const bool length = geometry.Units()[k] == "m";
      truth[k] += (length ? 2e-3 : .2 * M_PI / 180) * Normal(&random);
    }
    geometry.SetValues(truth);
    robot = geometry.ApplyTo(nominal);
    X_WB.linear() = RotationFromRpy({.1, -.2, 2});
    X_WB.translation() << 2, -1, .5;
  }

  PoseMeasurements Measure(Instrument instrument, int poses, double noise,
                           const Eigen::VectorXd& held = {}) {
    PoseMeasurements m;
    const int n = nominal.num_joints();
    m.q.resize(poses, n);
    if (instrument == Instrument::kTargets) {
      m.targets.assign(3, Eigen::MatrixXd(poses, 3));
    } else if (instrument == Instrument::kPoses) {
      m.poses.resize(poses, 7);
    } else {
      m.lengths.resize(poses);
    }
    for (int k = 0; k < poses; ++k) {
      Eigen::VectorXd q = UniformVector(&random, n, -2, 2);
      for (int j = 0; j < held.size(); ++j) {
        if (!std::isnan(held[j])) q[j] = held[j];
      }
      m.q.row(k) = q;
      m.row.push_back(k + 2);
      const Eigen::Isometry3d X_WT = X_WB * ToolPose(robot, q);
      const auto error = [&]() -> Eigen::Vector3d {
        return noise * Eigen::Vector3d(Normal(&random), Normal(&random),
                                       Normal(&random));
      };
      for (size_t t = 0; t < m.targets.size(); ++t) {
        m.targets[t].row(k) =
            X_WT * Eigen::Vector3d(.1 * Eigen::Vector3d::Unit(t)) + error();
      }
      if (m.poses.size() > 0) {
        const Eigen::Vector3d w = kAngular / kNoise * error();
        const Eigen::Quaterniond turn(
            Eigen::AngleAxisd(w.norm(), w.stableNormalized()) * X_WT.linear());
        m.poses.row(k) << (X_WT.translation() + error()).transpose(), turn.w(),
            turn.vec().transpose();
      }
      if (m.lengths.size() > 0) {
        m.lengths[k] = (X_WT.translation() - anchor).norm() + .3 + error().x();
      }
    }
    return m;
  }

  std::mt19937_64 random;
  Robot nominal, robot;
  Eigen::VectorXd truth;
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  Eigen::Vector3d anchor{1, 1.5, .4};
};

}  // namespace armcal
