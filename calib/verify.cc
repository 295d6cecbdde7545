#include "calib/verify.h"

#include <cmath>
#include <limits>
#include <utility>

#include "calib/log_readings.h"
#include "calib/logs/drawn_torques.h"
#include "calib/refine/calibration_reader.h"
#include "calib/refine/parameter_posterior.h"
#include "calib/verify/verification_report.h"
#include "model/robot_files/controller_reader.h"
#include "model/signals/bandwidth.h"
#include "model/text/input_text.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

class Verifier {
 public:
  Verifier(const Robot& robot, const VerifyOptions& options)
      : file_(robot), options_(options) {
    options_.reading.joint_names = robot.JointNames();
    if (!options.calibration.empty()) {
      calibrated_ =
          ReadCalibration(CalibrationFile(options.calibration), robot);
    }
    report_.robot = calibrated_ ? calibrated_->robot : robot;
    report_.calibration = options.calibration;
    report_.calibration_converged = !calibrated_ || calibrated_->converged;
    report_.seed = options.seed;
    dynamics_.seed = options.seed;
    dynamics_.progress = options.progress;
  }

  VerifySummary Run(const LogInput& input);

 private:
  const CalibratedRobot* calibrated() const {
    return calibrated_ ? &*calibrated_ : nullptr;
  }
  // What follows the command of the one log; true where the log has nothing
  // else to say, because it has no torques.
  bool CloseLoop(const LogInput& input);
  void VerifyOnLogs(const LogInput& input, VerifySummary* summary);
  double BandwidthFor(const LogSet& logs) const;
  std::vector<std::string> SeenLogs(const LogSet& logs) const;
  DrawnTorques Draw(const PreparedLogs& logs) const;

  const Robot& file_;
  VerifyOptions options_;
  std::optional<CalibratedRobot> calibrated_;
  VerificationReport report_;
  VerificationOptions dynamics_;
};

double Verifier::BandwidthFor(const LogSet& logs) const {
  if (options_.bandwidth_hz) return *options_.bandwidth_hz;
  return calibrated_ ? calibrated_->bandwidth_hz
                     : DefaultBandwidth(logs.time_bases());
}

std::vector<std::string> Verifier::SeenLogs(const LogSet& logs) const {
  std::vector<std::string> seen;
  for (int k = 0; k < logs.size(); ++k) {
    if (calibrated_->Saw(logs.path(k), logs.time_bases()[k].range)) {
      seen.push_back(logs.path(k));
    }
  }
  return seen;
}

bool Verifier::CloseLoop(const LogInput& input) {
  const LogSource& log = input.logs.at(0);
  const CommandedLog commanded =
      ReadCommandedLog(log, options_.reading, input.crop);
  report_.closed_loop = CompareClosedLoop(
      file_, calibrated(),
      ReadController(options_.controller, file_, commanded.log.qref.row(0)),
      commanded);
  if (commanded.log.tau.size() > 0) return false;
  report_.verification = VerifyDynamics(report_.robot, dynamics_, nullptr);
  if (calibrated_ && calibrated_->Saw(log.name, input.crop)) {
    report_.seen_logs = report_.logs;
  }
  return true;
}

// The torques of the file's robot, and of the calibrated one.
DrawnTorques Verifier::Draw(const PreparedLogs& logs) const {
  std::vector<TracedModel> models = {TraceRobot("the robot file", file_, {})};
  if (calibrated_) {
    models.push_back(
        TraceRobot("calibrated", calibrated_->robot, calibrated_->transitions));
  }
  return DrawTorques(models, options_.progress, logs);
}

void Verifier::VerifyOnLogs(const LogInput& input, VerifySummary* summary) {
  report_.logs = NamesOf(input.logs);
  for (const DataFinding& found :
       MendPositions(file_, UsedParts({&input}), &options_.reading)) {
    report_.warnings.push_back(found.finding + ": " + found.evidence + "; " +
                               found.flag);
  }
  if (!options_.controller.empty() && CloseLoop(input)) return;
  const LogSet logs(input.logs, options_.reading, input.crop);
  if (calibrated_) report_.seen_logs = SeenLogs(logs);
  PreparationOptions prepared;
  prepared.bandwidth_hz = BandwidthFor(logs);
  const PreparedLogs states = Prepare(logs, prepared);
  report_.verification = VerifyDynamics(report_.robot, dynamics_, &states);
  report_.log_torques =
      CompareLogTorques(file_, calibrated(), options_.progress, states);
  RolloutOptions rollouts;
  rollouts.progress = options_.progress;
  rollouts.simbody_s = options_.budget_s == 0
                           ? std::numeric_limits<double>::infinity()
                           : options_.budget_s;
  report_.rollouts = CompareRollouts(file_, calibrated(), rollouts,
                                     prepared.bandwidth_hz, report_.seed, logs);
  if (!options_.draw_torques) return;
  summary->torques = std::make_shared<DrawnTorques>(
      Draw(Prepare(logs, PreparationFor(rollouts, prepared.bandwidth_hz))));
}

VerifySummary Verifier::Run(const LogInput& input) {
  VerifySummary summary;
  if (options_.progress) options_.progress("verifying", -1);
  if (input.logs.empty()) {
    report_.verification = VerifyDynamics(report_.robot, dynamics_, nullptr);
  } else {
    VerifyOnLogs(input, &summary);
  }
  summary.shortcomings = report_.Shortcomings();
  summary.positive = summary.shortcomings.empty();
  summary.report = FullReport(report_);
  summary.json = ToJson(report_).dump(2) + "\n";
  summary.files = {{"verification.json", summary.json}};
  summary.robot = report_.robot;
  summary.details =
      std::make_shared<const VerificationReport>(std::move(report_));
  return summary;
}

}  // namespace

VerifySummary Verify(const Robot& robot, const LogInput& logs,
                     const VerifyOptions& options) {
  if (!options.controller.empty() && logs.logs.size() != 1) {
    throw OptionError(OptionName("controller") +
                      " follows the command of one log: " + OptionName("log") +
                      "=FILE");
  }
  if (!(options.budget_s >= 0) || !std::isfinite(options.budget_s)) {
    throw OptionError(OptionName("budget") + ": found '" +
                      NumberText(options.budget_s) +
                      "', expected seconds, or 0 for all that there is");
  }
  return Verifier(robot, options).Run(logs);
}

}  // namespace armcal
