#pragma once

#include <string>
#include <vector>

#include "calib/poses/calibration.h"
#include "calib/poses/diagnosis/finding.h"
#include "model/text/progress.h"

namespace armcal {

struct PoseDiagnosisOptions {
  PoseCalibrationOptions geometry;
  std::vector<std::string> without;  // names of effects not to be considered
  bool weighed = false;              // KnownArm
  std::vector<double> gear_ratios;
  std::vector<Told> compliance;
  Progress progress;
};

// Which effects a campaign of measured poses shows beyond the geometry.
PoseDiagnosis DiagnosePoseGap(const Robot& robot,
                              const PoseMeasurements& measured,
                              const PoseDiagnosisOptions& options);

}  // namespace armcal
