#include "calib/closed_loop/replay.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "model/dynamics/rigid_arm.h"
#include "model/plant/closed_loop.h"
#include "model/plant/motion_reader.h"
#include "model/signals/uneven_differences.h"
#include "model/text/input_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kCatchUp = 1;  // s

// The command as a motion. Feedforward takes its accelerations, which differ
// from those of second-order differences by several percent of the torque.
Log CommandOf(const Log& log) {
  Log command;
  command.t = log.t;
  command.q = log.qref;
  command.first_row = log.first_row;
  command.qd = DifferentiateUneven(command.t, command.q);
  command.qdd = DifferentiateUneven(command.t, command.qd);
  return command;
}

// When a clock shows `stamp`, by fixed-point iteration t <- t - (clock(t) -
// stamp), which converges at the rate by which the clock is wrong: clocks are
// nearly right.
double TrueTime(const std::function<double(double)>& clock, double stamp) {
  double t = stamp;
  for (int k = 0; clock && k < 5; ++k) t -= clock(t) - stamp;
  return t;
}

// A motion that was logged by this clock, in true time.
ReferenceMotion InTrueTime(const ReferenceMotion& logged,
                           const std::function<double(double)>& clock) {
  if (!clock) return logged;
  const double h = 1e-3;
  return {TrueTime(clock, logged.duration), [logged, clock, h](double t) {
            ReferencePoint point = logged.at(clock(t));
            const double rate = (clock(t + h) - clock(t - h)) / (2 * h);
            point.qd *= rate;
            point.qdd *= rate * rate;
            return point;
          }};
}

// Columns of a run's log at true time t, linear between its rows.
Eigen::RowVectorXd At(const MatrixXd& x, double rate_hz, double t) {
  const double row = std::clamp(t * rate_hz, 0.0, x.rows() - 1.0);
  const Eigen::Index k = std::min(static_cast<Eigen::Index>(row), x.rows() - 2);
  return (1 - (row - k)) * x.row(k) + (row - k) * x.row(k + 1);
}

}  // namespace

CommandedLog ReadCommandedLog(const LogSource& source,
                              const LogReaderOptions& given,
                              const TimeRange& crop) {
  LogReaderOptions options = given;
  options.commands_do = true;
  options.left_out.clear();
  return CommandedRows(source.name, ReadWholeLog(source, options), crop, given);
}

// Rows whose stamp does not grow are left out, too: a clock that repeats has no
// motion.
CommandedLog CommandedRows(const std::string& path, const Log& all,
                           const TimeRange& crop,
                           const LogReaderOptions& options) {
  if (all.qref.size() == 0) {
    throw InputError(path, "header", "",
                     "expected a column qref1.. for every joint, the command "
                     "that " +
                         OptionName("controller") + " is to follow");
  }
  const std::vector<RowRange> left_out = options.LeftOutOf(path);
  std::vector<int> rows, commands;
  for (int k = 0; k < all.size(); ++k) {
    const bool repeated =
        !commands.empty() && all.t[k] <= all.t[commands.back()];
    if (!crop.Contains(all.t[k]) || repeated) continue;
    if (!AnyContains(left_out, k)) rows.push_back(k);
    if (!rows.empty()) commands.push_back(k);
  }
  if (rows.empty() || all.t[rows.back()] - all.t[rows.front()] <= kCatchUp) {
    throw InputError(path, "", "",
                     "expected more than a second of time to simulate");
  }
  CommandedLog commanded;
  commanded.path = path;
  commanded.begin = all.t[rows.front()];
  Log& log = commanded.log;
  log.t = all.t(rows).array() - all.t[rows.front()];
  log.q = all.q(rows, Eigen::all);
  if (all.tau.size() > 0) log.tau = all.tau(rows, Eigen::all);
  log.qref = all.qref(rows, Eigen::all);
  log.first_row = all.first_row + rows.front();
  while (commands.back() > rows.back()) commands.pop_back();
  if (commands.size() > rows.size()) {
    commanded.command.t = all.t(commands).array() - all.t[rows.front()];
    commanded.command.qref = all.qref(commands, Eigen::all);
    commanded.command.first_row = log.first_row;
  }
  return commanded;
}

ReferenceMotion CommandedMotion(const CommandedLog& commanded) {
  const bool is_apart = commanded.command.size() > 0;
  return MotionThrough(commanded.path,
                       CommandOf(is_apart ? commanded.command : commanded.log));
}

int FirstCounted(const Log& log) {
  int row = 0;
  while (log.t[row] < kCatchUp) ++row;
  return row;
}

// The loop runs in true time at the controller's rate and is logged in each
// period; rows of the log are looked up where their stamps are in true time.
ClosedLoopReplay ReplayClosedLoop(const SimulatedRobot& plant, double delay,
                                  const Robot& known,
                                  const ControllerOptions& controller,
                                  const CommandedLog& commanded) {
  const Log& log = commanded.log;
  const int n = known.num_joints();
  SimulatedRobot delayed = plant;
  delayed.torque_delay += delay;
  ClosedLoopOptions options;
  options.controller = controller;
  options.sensors.log_rate_hz = controller.rate_hz;
  RigidArm engine(plant.robot);
  const ReferenceMotion motion =
      InTrueTime(CommandedMotion(commanded), plant.clock);
  const ClosedLoopRun run =
      RunClosedLoop(delayed, known, motion, options, &engine);
  ClosedLoopReplay replay;
  replay.finite = run.finite;
  if (!run.finite) return replay;
  const int first = FirstCounted(log);
  const int size = log.size() - first;
  replay.position.resize(size, n);
  const bool has_torque = log.tau.size() > 0;
  if (has_torque) replay.torque.resize(size, n);
  for (int k = 0; k < size; ++k) {
    const int row = first + k;
    const double t = TrueTime(plant.clock, log.t[row]);
    replay.position.row(k) =
        At(run.log.q, controller.rate_hz, t) - log.q.row(row);
    if (!has_torque) continue;
    replay.torque.row(k) =
        At(run.log.tau, controller.rate_hz, t) - log.tau.row(row);
  }
  return replay;
}

}  // namespace armcal
