// A robot and a log that no file holds: a pendulum of 2 kg, .5 m from its
// hinge, whose torque is m g l cos(q) + m l^2 qdd + .3 qd, calibrated from it.

#include <cmath>
#include <iostream>

#include "calib/calibrate.h"

int main() try {
  armcal::Robot robot;
  robot.name = "pendulum";
  robot.links.resize(1);
  robot.links[0].name = "rod";
  robot.links[0].joint.name = "hinge";  // about the world's -y: up is positive
  robot.links[0].X_PF = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX());
  armcal::Log log;
  log.t = Eigen::VectorXd::LinSpaced(4001, 0, 20);
  const Eigen::ArrayXd t = log.t, w = 2 * t, v = 5.3 * t;
  log.q = w.sin() + .3 * v.sin();
  const Eigen::ArrayXd qd = 2 * w.cos() + 1.59 * v.cos();
  const Eigen::ArrayXd qdd = -4 * w.sin() - 8.427 * v.sin();
  log.tau = 9.81 * log.q.array().cos() + .5 * qdd + .3 * qd;
  armcal::CalibrateOptions options;
  options.equations.joint_terms = {armcal::JointTerm::kViscous};
  const armcal::CalibrateSummary result =
      armcal::Calibrate(robot, {{{"swings", log}}}, options);
  for (const armcal::EstimatedParameter& p : result.parameters) {
    std::cout << p.name << " = " << p.value << " " << p.unit << "\n";
  }
  return result.positive ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 3;
}
