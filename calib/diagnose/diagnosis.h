#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "calib/diagnose/data/audit.h"
#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/noise.h"
#include "calib/diagnose/joint_gap.h"
#include "calib/diagnose/judge/corrected_draws.h"
#include "calib/diagnose/judge/evidence.h"
#include "calib/diagnose/judge/findings.h"
#include "calib/diagnose/judge/forward.h"
#include "calib/diagnose/judge/moved.h"
#include "calib/diagnose/judge/probability.h"
#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/judge/runs.h"
#include "calib/diagnose/judge/shown.h"
#include "calib/diagnose/judge/testability.h"
#include "calib/diagnose/judge/verdict.h"
#include "calib/diagnose/select/missing_terms.h"
#include "calib/diagnose/select/selection.h"
#include "calib/logs/log_set.h"
#include "calib/logs/torque_trace.h"
#include "model/log_files/time_base.h"

namespace armcal {

struct DiagnosisOptions {
  BaselineOptions baseline;
  // Of the torque residual, Hz. Not given: DiagnosisBandwidth of the training
  // logs.
  std::optional<double> bandwidth_hz;
  SelectionOptions selection;
  std::vector<std::string> without;  // effects that are not considered
  // Whether the trust in the file's inertial parameters is a guess, which logs
  // without a reference may raise (LikeliestTrust).
  bool may_trust_less = false;
  // The trust in those that a reference shows where nothing else of it is
  // believed (GapDiagnosis::not_of_reference).
  double trust_in_links = BaselineOptions().trust;
  // What makes these logs those of another arm; nothing is told of it then.
  // Asked when all else is known; may be empty.
  std::function<std::vector<DataFinding>()> wrong_readings;
  std::uint64_t seed = 1;
  // Whether held-out logs are simulated as well; along their commands where
  // these and the controller are given, else over windows.
  bool forward = true;
  std::optional<ControllerOptions> controller;
  std::vector<CommandedLog> commanded;
  int samples = 0;  // robots to draw from what is known in the end
  Progress progress;
};

struct GapDiagnosis {
  GapVerdict verdict = GapVerdict::kNoiseFloor;
  std::vector<FoundEffect> effects;  // strongest first
  // Fitted as well, but not claimed: no part of any figure.
  std::vector<FoundEffect> unnamed;
  std::vector<PlacedEffect> candidates;
  std::vector<MovedParameter> moved;
  std::vector<ShownEffect> shown;  // what a reference shows of itself
  std::vector<RunDrift> drifts;    // from log to log
  NoiseFloor floor = NoiseFloor::kAssumed;
  bool has_reference = false;
  // How many logs the reference is: told by who opened them; 0: not told. A
  // single one does not show how logs of one robot differ by themselves.
  int reference_logs = 0;
  bool has_calibration = false;  // whether the robot is a calibrated one
  // What the logs that it was calibrated on stand for
  // (DiagnoseSinceCalibration).
  enum class CalibrationsLogs { kUnknown, kHaveItToo, kAreTheReference };
  CalibrationsLogs calibrations_logs = CalibrationsLogs::kUnknown;
  GapFigures torque;
  std::optional<ForwardGap> forward;
  // What the file gives no joint at all, or has wrong on many joints.
  MissingTerms ladder;
  // Joint terms that a reference has otherwise on many joints: has_reference is
  // false then, as it tells of the links alone.
  std::vector<const Effect*> not_of_reference;
  CorrectedRobot corrected;
  CorrectedDraws draws;  // of it; none where none were asked for
  std::vector<JointGap> joints;
  std::vector<TorqueTrace> traces;  // of what is held out, TraceHeldOut
  Unexplained unexplained;
  // Whether it is unknown what is left of held-out data alone (IsLoudHeldOut).
  bool only_held_out_left = false;
  std::vector<DataFinding> data;
  std::vector<UntestableEffect> untestable;
  double bandwidth_hz = 0;
  double trust = 0;  // in the file's inertial parameters, relative deviations
  double torque_constants_stddev = 0;  // relative, LogSet
};

// Diagnoses the gap between `robot` and the training logs; figures are of the
// validation logs, or of parts of the training logs that are held out where
// there are none. `reference`: logs of the robot before, which the baseline is
// fitted to as well; null: none.
GapDiagnosis DiagnoseGap(const Robot& robot, const DiagnosisOptions& options,
                         const LogSet& training, const LogSet* validation,
                         const LogSet* reference);

}  // namespace armcal
