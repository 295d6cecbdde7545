#include "calib/diagnose/since_calibration.h"

#include <algorithm>
#include <memory>

#include "calib/diagnose/candidates/effect_odds.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/segments.h"
#include "calib/diagnose/select/reference_fit.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

// The calibrated robot's own logs with its numbers fitted to them anew, as far
// from the calibrated ones as they like, and with nothing that models lack as a
// rule: that could take the place of an effect, or of its opposite.
class OwnLogs {
 public:
  // `beside`: what a reference is fitted with.
  OwnLogs(const Robot& robot, const DiagnosisOptions& beside,
          const GapDiagnosis& found, const LogSet& own)
      : scale_(found.corrected.scale),
        segments_(Segments(beside, found, own)),
        baseline_(robot, beside.baseline, UsualTorque(segments_)) {
    for (GapSegment& segment : segments_) {
      SmoothTorque& torque = segment.motion.torque;
      torque.tau = ZeroPhaseLowPass(
          RecordedTorque(robot, baseline_.transitions(), segment.motion)
              .nominal(),
          1 / segment.motion.dt, torque.hz);
    }
    data_ = std::make_unique<GapData>(segments_, baseline_, found.bandwidth_hz);
    FitWithNoise(data_.get());
  }

  // Whether they have an effect at this size.
  bool Have(const GapCandidate& effect) {
    return ShareIn(baseline_, scale_, effect, data_->Screen(), data_.get())
               .odds() > 0;
  }

 private:
  // Numbered after the diagnosed ones: what happened once did not in these.
  static std::vector<GapSegment> Segments(const DiagnosisOptions& beside,
                                          const GapDiagnosis& found,
                                          const LogSet& own) {
    std::vector<GapSegment> segments =
        ReadSegments(found.bandwidth_hz, beside.progress, own);
    Eigen::VectorXd usual_temperature;
    SetUsualTemperature(&usual_temperature, &segments);
    int logs = 0;
    for (const CarriedEffect& effect : found.corrected.effects) {
      logs = std::max(logs, effect.found.log + 1);
    }
    for (GapSegment& segment : segments) segment.log += logs;
    return segments;
  }

  MotionScale scale_;
  std::vector<GapSegment> segments_;
  GapBaseline baseline_;
  std::unique_ptr<GapData> data_;
};

// Whether all that is claimed is what the model lacks. Nothing claimed answers
// neither question.
bool IsWhatTheModelLacks(const Robot& robot, const DiagnosisOptions& beside,
                         const GapDiagnosis& found, const LogSet& own) {
  const auto& effects = found.corrected.effects;
  if (found.effects.empty() || effects.empty()) return false;
  OwnLogs logs(robot, beside, found, own);
  return std::all_of(
      effects.begin(), effects.end(),
      [&](const CarriedEffect& effect) { return logs.Have(effect.found); });
}

}  // namespace

bool TellsOfAChange(const GapDiagnosis& changed) {
  return !changed.effects.empty() ||
         std::any_of(changed.unnamed.begin(), changed.unnamed.end(),
                     [](const FoundEffect& one) { return one.one_of_few; });
}

GapDiagnosis DiagnoseSinceCalibration(const Robot& calibrated,
                                      const DiagnosisOptions& options,
                                      double trust_beside_own,
                                      const LogSet& training,
                                      const LogSet* validation,
                                      const LogSet& own) {
  DiagnosisOptions beside = options;
  beside.baseline.posterior = nullptr;
  beside.baseline.trust = trust_beside_own;
  GapDiagnosis changed =
      DiagnoseGap(calibrated, beside, training, validation, &own);
  changed.has_calibration = true;
  changed.calibrations_logs = GapDiagnosis::CalibrationsLogs::kAreTheReference;
  if (TellsOfAChange(changed)) return changed;
  GapDiagnosis lacks =
      DiagnoseGap(calibrated, options, training, validation, nullptr);
  if (lacks.verdict == GapVerdict::kNotTestable) return lacks;
  if (!IsWhatTheModelLacks(calibrated, beside, lacks, own)) return changed;
  lacks.calibrations_logs = GapDiagnosis::CalibrationsLogs::kHaveItToo;
  return lacks;
}

}  // namespace armcal
