#include "tools/diagnose.h"

#include <gflags/gflags.h>

#include <cmath>
#include <iostream>
#include <memory>

#include "calib/gap_report.h"
#include "tools/calibrate_refined.h"
#include "tools/input_flags.h"
#include "tools/output_folder.h"
#include "tools/progress_bar.h"

DEFINE_string(reference, "",
              "log of the same robot from before: the model is fitted to it "
              "first, and the diagnosis says what has changed since");

namespace armcal {
namespace {

int RunDiagnose() {
  CheckLogsApart();
  const Robot robot = RobotFromFlags();
  const LogReaderOptions log_options = LogOptionsFromFlags(robot);
  LogSet training(LogsFromFlags(), log_options, CropFromFlags());
  DiagnosisOptions options;
  ProgressBar bar;
  options.progress = [&bar](const std::string& stage, double fraction) {
    bar.Show(stage, fraction);
  };
  options.baseline.trust = TrustFromFlags().inertia;
  options.bandwidth_hz =
      BandwidthFromFlags().value_or(DefaultBandwidth(training.time_bases()));
  std::unique_ptr<LogSet> reference, validation;
  if (!FLAGS_reference.empty()) {
    reference = std::make_unique<LogSet>(SplitAtCommas(FLAGS_reference),
                                         log_options, TimeRange());
  }
  const std::vector<std::string> held_out = ValidationLogsFromFlags();
  if (!held_out.empty()) {
    validation = std::make_unique<LogSet>(held_out, log_options,
                                          ValidationCropFromFlags());
  }
  const GapDiagnosis diagnosis =
      DiagnoseGap(robot, options, &training, validation.get(), reference.get());
  OutputFolder out(OutFromFlags());
  out.Add("diagnosis.json", ToJson(diagnosis).dump(2) + "\n");
  out.Write();
  std::cout << FullReport(diagnosis);
  return kExitOk;
}

}  // namespace

Command DiagnoseCommand() {
  return {"diagnose",
          "where the sim-to-real gap lies, which effect causes it, and how far "
          "it shrinks once that effect is in the model",
          {"robot", "log", "validate", "reference", "trust", "bandwidth",
           "crop", "validate_crop", "out", "base", "tip", "gravity",
           "torque_kind", "torque_constants", "gear_ratios", "seed"},
          &RunDiagnose};
}

}  // namespace armcal
