#include "calib/closed_loop_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/arm_engine.h"
#include "model/input_error.h"
#include "model/low_pass.h"
#include "model/plant/closed_loop.h"
#include "model/plant/motion_reader.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kCatchUp = 1;  // s
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// The joint terms that a simulated robot does not have by itself.
JointLaw TermsLaw(int j, const Joint& joint, const CoulombTransition& t) {
  JointLaw law;
  law.joint = j;
  law.initial_state = VectorXd::Zero(1);  // of Coulomb friction
  law.torque = [j, joint, t](const ArmInstant& instant, const double* state,
                             double* rate) {
    const double qd = instant.velocity[j];
    rate[0] = t.StateRate(qd, state[0]);
    return -FrictionTorque(joint, t, qd, state[0]);
  };
  return law;
}

ClosedLoopRun Follow(const Robot& robot, const Robot& file,
                     const std::vector<CoulombTransition>& transitions,
                     const ControllerOptions& controller,
                     const ReferenceMotion& motion) {
  SimulatedRobot plant;
  plant.robot = robot;
  for (int j = 0; j < robot.num_joints(); ++j) {
    plant.joint_laws.push_back(
        TermsLaw(j, robot.links[j].joint, transitions[j]));
  }
  ClosedLoopOptions options;
  options.controller = controller;
  options.sensors.log_rate_hz = controller.rate_hz;
  const ArmEngine engine = MakeArmEngine(robot);
  return RunClosedLoop(plant, file, motion, options, engine.dynamics.get());
}

// Columns of a run's log at time t, linear between its rows.
Eigen::RowVectorXd At(const Eigen::MatrixXd& x, double rate_hz, double t) {
  const double row = std::clamp(t * rate_hz, 0.0, x.rows() - 1.0);
  const Eigen::Index k = std::min(static_cast<Eigen::Index>(row), x.rows() - 2);
  return (1 - (row - k)) * x.row(k) + (row - k) * x.row(k + 1);
}

struct Deviation {
  VectorXd position, torque;  // rms per joint
};

Deviation Compare(const ClosedLoopRun& run, double rate_hz, const Log& log) {
  const Eigen::Index n = log.q.cols();
  Deviation d{VectorXd::Zero(n), VectorXd::Zero(n)};
  if (!run.finite) {
    d.position.setConstant(std::numeric_limits<double>::infinity());
    d.torque = d.position;
    return d;
  }
  long count = 0;
  for (int k = 0; k < log.size(); ++k) {
    if (log.t[k] < kCatchUp) continue;
    ++count;
    d.position += (At(run.log.q, rate_hz, log.t[k]) - log.q.row(k))
                      .transpose()
                      .cwiseAbs2();
    d.torque += (At(run.log.tau, rate_hz, log.t[k]) - log.tau.row(k))
                    .transpose()
                    .cwiseAbs2();
  }
  d.position = (d.position / count).cwiseSqrt();
  d.torque = (d.torque / count).cwiseSqrt();
  return d;
}

// The command as a motion. Feedforward takes its accelerations, which differ
// from those of second-order differences by several percent of the torque.
Log CommandOf(const Log& log) {
  Log command;
  command.t = log.t;
  command.q = log.qref;
  command.first_row = log.first_row;
  const Eigen::Index steps = log.size() - 1;
  const Eigen::ArrayXd dt = log.t.tail(steps) - log.t.head(steps);
  if (log.size() > 8 && dt.maxCoeff() - dt.minCoeff() < 0.01 * dt.mean()) {
    command.qd = Differentiate(command.q, dt.mean());
    command.qdd = Differentiate(command.qd, dt.mean());
  }
  return command;
}

}  // namespace

Log ReadCommandedLog(const std::string& path, const LogReaderOptions& given,
                     const TimeRange& crop) {
  LogReaderOptions options = given;
  options.want_reference = true;
  const Log all = ReadWholeLog(path, options);
  if (all.qref.size() == 0) {
    throw InputError(path, "header", "",
                     "expected a column qref1.. for every joint, the command "
                     "that --controller is to follow");
  }
  std::vector<int> rows;
  for (int k = 0; k < all.size(); ++k) {
    const bool repeated = !rows.empty() && all.t[k] <= all.t[rows.back()];
    if (crop.Contains(all.t[k]) && !repeated) rows.push_back(k);
  }
  if (rows.empty() || all.t[rows.back()] - all.t[rows.front()] <= kCatchUp) {
    throw InputError(path, "", "",
                     "expected more than a second of time to simulate");
  }
  Log log;
  log.t = all.t(rows).array() - all.t[rows.front()];
  log.q = all.q(rows, Eigen::all);
  log.tau = all.tau(rows, Eigen::all);
  log.qref = all.qref(rows, Eigen::all);
  log.first_row = all.first_row + rows.front();
  return log;
}

ClosedLoopComparison CompareClosedLoop(const Robot& file,
                                       const CalibratedRobot* calibrated,
                                       const ControllerOptions& controller,
                                       const std::string& path,
                                       const Log& log) {
  const ReferenceMotion motion = MotionThrough(path, CommandOf(log));
  std::vector<CoulombTransition> transitions(file.num_joints());
  if (calibrated != nullptr) transitions = calibrated->transitions;
  const ClosedLoopRun before =
      Follow(file, file, transitions, controller, motion);
  const Deviation of_file = Compare(before, controller.rate_hz, log);
  const VectorXd none = VectorXd::Constant(file.num_joints(), kNaN);
  Deviation of_calibrated{none, none};
  ClosedLoopComparison result;
  result.before_finite = result.after_finite = before.finite;
  if (calibrated != nullptr) {
    const ClosedLoopRun after =
        Follow(calibrated->robot, file, transitions, controller, motion);
    of_calibrated = Compare(after, controller.rate_hz, log);
    result.after_finite = after.finite;
  }
  for (int j = 0; j < file.num_joints(); ++j) {
    const Joint& joint = file.links[j].joint;
    result.joints.push_back(
        {joint.name, PositionUnit(joint.type), of_file.position[j],
         of_calibrated.position[j], of_file.torque[j], of_calibrated.torque[j],
         std::sqrt(log.tau.col(j).squaredNorm() / log.size())});
  }
  return result;
}

}  // namespace armcal
