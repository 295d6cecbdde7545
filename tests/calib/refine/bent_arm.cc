#include "tests/calib/refine/bent_arm.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/fixtures/temp_file.h"

namespace armcal {

BentArm::BentArm(const std::string& arm_name, std::uint64_t seed)
    : random(seed), name(arm_name) {
  const SimulatedArm arm = MakeArm(name, kInertia, &random);
  file = arm.file;
  ArmGeometry geometry(file);
  names = geometry.Names();
  g = geometry.Values();
  for (int k = 4; k < geometry.size(); ++k) {  // base.pitch and roll: tilt
    if (geometry.IsTool(k)) continue;
    const bool length = geometry.Units()[k] == "m";
    g[k] += (length ? kLength : kAngle) * Normal(&random);
  }
  geometry.SetValues(g);
  truth = geometry.ApplyTo(arm.truth);
}

Log BentArm::Move(double duration, double dt) {
  Log log = RecordMotion(RandomMultisine(&random, file.num_joints(), 1.2),
                         duration, dt);
  SetTorque(truth, &log);
  return log;
}

void BentArm::SetTorque(const Robot& robot, Log* log) {
  log->tau.setZero(log->size(), robot.num_joints());
  AddTorque(robot, log);
  for (int j = 0; j < robot.num_joints(); ++j) {
    AddCoulomb(j, robot.links[j].joint.coulomb, kWidth, log);
    log->tau.col(j).array() += robot.links[j].joint.offset;
  }
}

std::string BentArm::Record(double duration) {
  Log log = Move(duration, .004);
  AddNoise(&random, .01 * ColumnRms(log.tau), &log.tau);
  AddNoise(&random, Eigen::VectorXd::Constant(log.q.cols(), 2e-5), &log.q);
  return WriteFile(LogCsv(log));
}

PoseMeasurements BentArm::Measure(Instrument instrument, int poses,
                                  double noise) {
  Plant plant(name, random());
  plant.robot = truth;
  return plant.Measure(instrument, poses, noise);
}

double BentArm::ValueOf(const PhysicalParameter& p) const {
  const auto at = std::find(names.begin(), names.end(), p.name);
  return at == names.end() ? ValueIn(truth, p.name) : g[at - names.begin()];
}

double ToolError(const Robot& a, const Robot& b) {
  constexpr int kPositions = 200;
  std::mt19937_64 random(5);
  Eigen::Matrix3Xd p(3, 2 * kPositions), seen = p;
  for (int k = 0; k < kPositions; ++k) {
    const auto q = UniformVector(&random, a.num_joints(), -2, 2);
    for (int end = 0; end < 2; ++end) {  // two points tell the orientation
      const Eigen::Vector3d point = .1 * end * Eigen::Vector3d::UnitX();
      p.col(2 * k + end) = ToolPose(a, q) * point;
      seen.col(2 * k + end) = ToolPose(b, q) * point;
    }
  }
  const Eigen::Matrix4d X = Eigen::umeyama(p, seen, false);
  const Eigen::Matrix3Xd moved =
      (X.topLeftCorner<3, 3>() * p).colwise() + X.topRightCorner<3, 1>();
  return (moved - seen).norm() / std::sqrt(2. * kPositions);
}

double TorqueError(const Robot& robot, const Log& exact) {
  Log predicted = exact;
  BentArm::SetTorque(robot, &predicted);
  return 100 * ColumnRms(predicted.tau - exact.tau)
                   .cwiseQuotient(ColumnRms(exact.tau))
                   .mean();
}

}  // namespace armcal
