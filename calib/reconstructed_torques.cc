#include "calib/reconstructed_torques.h"

#include <memory>
#include <utility>

#include "calib/closed_loop/commanded_torque.h"
#include "model/log_files/log_reader.h"
#include "model/robot_files/controller_reader.h"
#include "model/text/format.h"

namespace armcal {
namespace {

constexpr unsigned kNoiseSeed = 1;  // the same answer to the same logs

constexpr double kStandsAtLimit = .02;  // share of samples, as of AuditChannels
constexpr double kRoundingAtLimit = 1e-6;  // of rounding in a mean over periods

std::vector<DataFinding> TellLimits(const Robot& robot, const std::string& log,
                                    const ControllerOptions& law,
                                    const Eigen::MatrixXd& tau) {
  std::vector<DataFinding> told;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const double limit = law.drives[j].torque_limit;
    const Joint& joint = robot.links[j].joint;
    const auto at_limit =
        (tau.col(j).array().abs() >= (1 - kRoundingAtLimit) * limit).count();
    const double share =
        static_cast<double>(at_limit) / static_cast<double>(tau.rows());
    if (!(limit > 0) || share < kStandsAtLimit) continue;
    told.push_back(
        {"of " + log + " the torque that the drives' law gives " + joint.name +
             " stands at its limit",
         Format("%.0f %% of the samples are at %.4g %s, ", 100 * share, limit,
                IsRotational(joint.type) ? "N m" : "N") +
             (limit == joint.effort ? "the robot file's effort limit"
                                    : "the controller's torque_limit"),
         "torque_limit in the controller's file, where the drive has another"});
  }
  return told;
}

}  // namespace

std::vector<DataFinding> ReconstructTorques(const Robot& robot,
                                            const std::string& controller,
                                            const std::vector<LogSource>& logs,
                                            LogReaderOptions* reading) {
  std::vector<DataFinding> told;
  LogReaderOptions commands_do = *reading;
  commands_do.commands_do = true;
  for (const LogSource& source : logs) {
    if (LogReader(source, commands_do).has_torque()) continue;
    LogReaderOptions whole = commands_do;
    whole.left_out.clear();
    const Log all = ReadWholeLog(source, whole);
    const CommandedLog log = CommandedRows(source.name, all, {}, *reading);
    const ControllerOptions law =
        ReadController(controller, robot, log.log.qref.row(0));
    const Eigen::VectorXd times = all.t.array() - log.begin;
    ReconstructedTorque torque =
        ReconstructTorque(robot, law, log, times, kNoiseSeed);
    torque.t.array() += log.begin;
    for (DataFinding& limit : TellLimits(robot, source.name, law, torque.tau)) {
      told.push_back(std::move(limit));
    }
    torque.source = "commands and positions, by " + controller;
    reading->reconstructed_torque[source.name] =
        std::make_shared<const ReconstructedTorque>(std::move(torque));
  }
  return told;
}

}  // namespace armcal
