#include "calib/reconstructed_torques.h"

#include <memory>
#include <utility>

#include "calib/closed_loop/commanded_torque.h"
#include "model/log_files/log_reader.h"
#include "model/robot_files/controller_reader.h"

namespace armcal {
namespace {

constexpr unsigned kNoiseSeed = 1;  // the same answer to the same logs

}  // namespace

void ReconstructTorques(const Robot& robot, const std::string& controller,
                        const std::vector<LogSource>& logs,
                        LogReaderOptions* reading) {
  LogReaderOptions commands_do = *reading;
  commands_do.commands_do = true;
  for (const LogSource& source : logs) {
    if (LogReader(source, commands_do).has_torque()) continue;
    const Log all = ReadWholeLog(source, commands_do);
    const CommandedLog log = CommandedRows(source.name, all, {});
    const ControllerOptions law =
        ReadController(controller, robot, log.log.qref.row(0));
    ReconstructedTorque torque =
        ReconstructTorque(robot, law, log, all.t, kNoiseSeed);
    torque.source = "commands and positions, by " + controller;
    reading->reconstructed_torque[source.name] =
        std::make_shared<const ReconstructedTorque>(std::move(torque));
  }
}

}  // namespace armcal
