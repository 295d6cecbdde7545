#include "calib/closed_loop/comparison.h"

#include <cmath>
#include <limits>

#include "calib/closed_loop/replay.h"
#include "calib/logs/joint_term_laws.h"
#include "calib/numerics/undefined.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

ClosedLoopReplay Follow(const Robot& robot, const Robot& file,
                        const std::vector<CoulombTransition>& transitions,
                        const ControllerOptions& controller,
                        const CommandedLog& log) {
  SimulatedRobot plant;
  plant.robot = robot;
  for (int j = 0; j < robot.num_joints(); ++j) {
    AddJointTerms(j, {{robot.links[j].joint.coulomb, transitions[j]}}, &plant);
  }
  return ReplayClosedLoop(plant, 0, file, controller, log);
}

struct Deviation {
  VectorXd position, torque;  // rms per joint
};

Deviation RmsOf(const ClosedLoopReplay& replay, int n) {
  if (!replay.finite) {
    const VectorXd infinite = VectorXd::Constant(n, kNoLimit);
    return {infinite, infinite};
  }
  const double rows = std::sqrt(replay.position.rows());
  Deviation deviation{replay.position.colwise().norm() / rows,
                      VectorXd::Constant(n, kNaN)};
  if (replay.torque.size() > 0) {
    deviation.torque = replay.torque.colwise().norm() / rows;
  }
  return deviation;
}

}  // namespace

// Both robots are driven by a controller that knows the file's robot, as the
// real one is; the calibrated robot is to deviate from the log by less.
ClosedLoopComparison CompareClosedLoop(const Robot& file,
                                       const CalibratedRobot* calibrated,
                                       const ControllerOptions& controller,
                                       const CommandedLog& commanded) {
  const Log& log = commanded.log;
  const int n = file.num_joints();
  std::vector<CoulombTransition> transitions(n);
  if (calibrated != nullptr) transitions = calibrated->transitions;
  const ClosedLoopReplay before =
      Follow(file, file, transitions, controller, commanded);
  const Deviation of_file = RmsOf(before, n);
  const VectorXd none = VectorXd::Constant(n, kNaN);
  Deviation of_calibrated{none, none};
  ClosedLoopComparison result;
  result.before_finite = result.after_finite = before.finite;
  if (calibrated != nullptr) {
    const ClosedLoopReplay after =
        Follow(calibrated->robot, file, transitions, controller, commanded);
    of_calibrated = RmsOf(after, n);
    result.after_finite = after.finite;
  }
  for (int j = 0; j < n; ++j) {
    const Joint& joint = file.links[j].joint;
    result.joints.push_back(
        {joint.name, PositionUnit(joint.type), of_file.position[j],
         of_calibrated.position[j], of_file.torque[j], of_calibrated.torque[j],
         log.tau.size() == 0
             ? kNaN
             : std::sqrt(log.tau.col(j).squaredNorm() / log.size())});
  }
  return result;
}

}  // namespace armcal
