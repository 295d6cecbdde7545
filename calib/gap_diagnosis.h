#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "calib/gap_baseline.h"
#include "calib/gap_candidates.h"
#include "calib/gap_noise.h"
#include "calib/gap_selection.h"
#include "calib/log_set.h"

namespace armcal {

struct DiagnosisOptions {
  BaselineOptions baseline;
  double bandwidth_hz = 0;
  SelectionOptions selection;
  Progress progress;
};

enum class GapVerdict {
  kNoiseFloor,
  kAbsorbed,
  kExplained,
  kPartlyExplained,
  kUnknown,
  kNotTestable
};
const char* GapVerdictName(GapVerdict verdict);

struct DiagnosedEffect {
  const Effect* effect = nullptr;
  int joint = -1;  // from 0; -1: all joints or the whole robot
  double probability = 0;
  double score = 0;
  double drop = 0;
  Eigen::VectorXd p;
  std::vector<EffectEstimate> estimates;
  std::vector<double> stddev;  // of the estimates
};

struct GapDiagnosis {
  GapVerdict verdict = GapVerdict::kNoiseFloor;
  std::vector<DiagnosedEffect> effects;
  NoiseFloor floor = NoiseFloor::kAssumed;
};

GapDiagnosis DiagnoseGap(const Robot& robot, const DiagnosisOptions& options,
                         LogSet* training, LogSet* validation,
                         LogSet* reference);

}  // namespace armcal
