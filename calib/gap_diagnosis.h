#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "calib/gap_baseline.h"
#include "calib/gap_noise.h"
#include "calib/gap_probability.h"
#include "calib/gap_selection.h"
#include "calib/gap_shrink.h"
#include "calib/gap_where.h"
#include "calib/log_set.h"
#include "model/time_base.h"

namespace armcal {

struct DiagnosisOptions {
  BaselineOptions baseline;
  double bandwidth_hz = 0;
  SelectionOptions selection;
  std::uint64_t seed = 1;
  Progress progress;
};

// DESIGN.md, diagnosis.json.
enum class GapVerdict {
  kNoiseFloor,
  kAbsorbed,
  kExplained,
  kPartlyExplained,
  kUnknown,
  kNotTestable
};
const char* GapVerdictName(GapVerdict verdict);

// What speaks for an effect besides its score, and against the catalogue.
struct EffectEvidence {
  double odds = 0;      // ln of its softmax probability against all others'
  double strength = 0;  // ln of its drop of chi^2
  double share = 1;     // of the drops of all that were chosen
  int chosen = 1;       // how many were
  double left = 0;      // share of the excess that all leave, in sample
  double held_out_left = 0;  // the same on what was held out
  double next = 0;           // score of the best further candidate, at least 0
  double gain = 0;           // by how much it lowers the held-out mean square
};

// One effect that was found.
struct FoundEffect {
  const Effect* effect = nullptr;
  int joint = -1;  // from 0; -1: all joints or the whole robot
  double probability = 0;
  double score = 0;
  double drop = 0;  // of chi^2 when it is left out
  EffectEvidence evidence;
  Eigen::VectorXd p;
  std::vector<EffectEstimate> estimates;
  std::vector<double> stddev;  // of the estimates
  // Others that these data cannot tell from it.
  std::vector<PlacedEffect> equivalent;
  // Of the held-out gap, by this one beside the others.
  double removed_percent = 0;
  double ci95[2] = {0, 0};
  std::string separate_by;         // the experiment that would tell them apart
  std::vector<TimeRange> windows;  // s, of what comes and goes
};

// Something about the data that a diagnosis depends on.
struct DataFinding {
  std::string finding;
  std::string evidence;
  std::string flag;  // what to change, or empty
};

struct UntestableEffect {
  std::string effect;
  std::string joint;  // empty: the whole robot, or all joints
  std::string why;
};

// What is left beside the effects that were found.
struct Unexplained {
  std::string joint;
  std::string organised_by;
  double share = 0;  // of the refitted model's excess over the noise
};

struct JointGap {
  std::string name;
  std::string unit;
  // rms of the held-out torque residual, N m or N.
  double nominal_rms = 0, refit_rms = 0, after_rms = 0, floor_rms = 0;
  Organisation organised;  // of the refitted model's residual
  double unexplained = 0;  // chi^2 over rows after the effects, less 1
};

// A parameter of the baseline that is far from where it was said to be.
struct MovedParameter {
  std::string name;
  std::string unit;
  double nominal = 0, value = 0, stddev = 0;
  double deviations = 0;  // of the prior
};

struct GapDiagnosis {
  GapVerdict verdict = GapVerdict::kNoiseFloor;
  std::vector<FoundEffect> effects;  // strongest first
  std::vector<PlacedEffect> candidates;
  std::vector<MovedParameter> moved;
  NoiseFloor floor = NoiseFloor::kAssumed;
  GapFigures torque;
  std::vector<JointGap> joints;
  Unexplained unexplained;
  std::vector<DataFinding> data;
  std::vector<UntestableEffect> untestable;
  double bandwidth_hz = 0;
};

// Diagnoses the gap between `robot` and the training logs; figures are of the
// validation logs, or of parts of the training logs that are held out where
// there are none. `reference`: logs of the robot before, which the baseline is
// fitted to as well; null: none.
GapDiagnosis DiagnoseGap(const Robot& robot, const DiagnosisOptions& options,
                         LogSet* training, LogSet* validation,
                         LogSet* reference);

}  // namespace armcal
