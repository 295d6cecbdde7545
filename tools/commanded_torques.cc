#include "tools/commanded_torques.h"

#include <gflags/gflags.h>

#include <memory>
#include <utility>

#include "calib/commanded_torque.h"
#include "calib/log_set.h"
#include "calib/torque_levels.h"
#include "tools/simulation_flags.h"

DECLARE_string(controller);

namespace armcal {
namespace {

bool HasTorque(const std::string& path, LogReaderOptions options) {
  options.commands_do = true;
  return LogReader(path, options).has_torque();
}

// Takes from the torques what integrals had at the logs' begin.
void Level(const Robot& robot, const std::vector<DriveLaw>& drives,
           const std::vector<std::string>& paths, LogReaderOptions* options) {
  LogSet logs(paths, *options, {});
  logs.Prepare(DefaultBandwidth(logs.time_bases()), 0);
  const std::vector<Eigen::VectorXd> levels = TorqueLevels(robot, &logs);
  for (size_t log = 0; log < paths.size(); ++log) {
    MadeTorque leveled = *options->made_torque.at(paths[log]);
    for (int j = 0; j < robot.num_joints(); ++j) {
      const bool integrates = drives[j].ki > 0 || drives[j].velocity_ki > 0;
      if (integrates) leveled.tau.col(j).array() -= levels[log][j];
    }
    options->made_torque[paths[log]] =
        std::make_shared<const MadeTorque>(std::move(leveled));
  }
}

}  // namespace

void MakeTorquesOfCommands(const Robot& robot,
                           const std::vector<std::string>& logs,
                           LogReaderOptions* options) {
  if (FLAGS_controller.empty()) return;
  std::vector<DriveLaw> drives;
  std::vector<std::string> made_of;
  for (const std::string& path : logs) {
    if (HasTorque(path, *options)) continue;
    const CommandedLog log = ReadCommandedLog(path, *options, {});
    const ControllerOptions controller =
        ControllerFromFlags(robot, log.log.qref.row(0));
    LogReaderOptions reading = *options;
    reading.need_torque = false;
    MadeTorque made;
    made.tau =
        CommandedTorque(robot, controller, log, ReadWholeLog(path, reading).t);
    made.source = "commands and positions, by " + FLAGS_controller;
    options->made_torque[path] =
        std::make_shared<const MadeTorque>(std::move(made));
    drives = controller.drives;
    made_of.push_back(path);
  }
  if (!made_of.empty()) Level(robot, drives, made_of, options);
}

}  // namespace armcal
