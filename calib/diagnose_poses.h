#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/poses/calibration.h"
#include "calib/robot_source.h"
#include "calib/summary.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"
#include "model/text/progress.h"

namespace armcal {

struct PoseDiagnosis;  // calib/poses/diagnosis/diagnosis.h

struct DiagnosePosesOptions {
  // What of the geometry is refined before effects are looked for, and how far
  // it may be from the file's.
  PoseCalibrationOptions geometry;
  std::vector<std::string> without;  // names of effects not to be considered
  // Poses that take no part in the fit, on which the correction is judged.
  std::optional<PoseMeasurements> validation;
  // The calibration.json of `armcal calibrate`, or its folder, whose masses are
  // those of the measured arm with its tool: sag is told per N m. Empty: none.
  std::string calibration;
  std::vector<double> gear_ratios;  // motor over joint; empty: not known
  // The diagnosis.json of `armcal diagnose` on logs, or its folder, whose
  // stiffnesses are one over the compliances that poses show. Empty: none.
  std::string compliance;
  RobotSource source;  // of robot.urdf
  Progress progress;
};

struct DiagnosePosesSummary : Summary {
  std::string verdict;               // "explained" .. (docs/diagnose.md)
  std::vector<std::string> effects;  // strongest first
  std::shared_ptr<const PoseDiagnosis> details;
};

// Where the error of an arm's geometry lies, which effect that links of fixed
// lengths lack causes it, and how far it shrinks once that effect is added.
// Positive: nothing was found, and nothing is left that is no noise. Throws
// OptionError.
DiagnosePosesSummary DiagnosePoses(const Robot& robot,
                                   const PoseMeasurements& measured,
                                   const DiagnosePosesOptions& options);

}  // namespace armcal
