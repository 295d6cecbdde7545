#include "calib/diagnose/names.h"

#include <algorithm>
#include <cmath>

#include "model/text/format.h"

namespace armcal {
namespace {

// Whether the sign of the first estimate is known, with 95 %: joints may tell a
// body's moment alone and leave its mass open.
bool IsSignKnown(const FoundEffect& found) {
  return !found.estimates.empty() && !found.stddev.empty() &&
         std::abs(found.estimates[0].value) > 2 * found.stddev[0];
}

// Whether a sign of the effect's first estimate says which way it goes. Several
// linear parameters (a sine and a cosine) have no such way, but those of a body
// do; one that cannot be negative has only one.
bool HasDirection(const FoundEffect& found) {
  if (IsCarriedBody(*found.effect)) return IsSignKnown(found);
  using Parameter = EffectParameter;
  const std::vector<Parameter>& all = found.effect->parameters;
  const auto is_linear = [](const Parameter& parameter) {
    return parameter.search == Parameter::Search::kLinear;
  };
  const auto first = std::find_if(all.begin(), all.end(), is_linear);
  return std::count_if(all.begin(), all.end(), is_linear) == 1 &&
         first->sign == Parameter::Sign::kFree && !found.estimates.empty() &&
         found.estimates[0].value != 0;
}

// "-0.08", "+0.018 rad", "the log has torque late by 0.02 s".
std::string SignedSize(const Effect& effect, const EffectEstimate& size) {
  const std::string unit = size.unit == "1" ? "" : " " + size.unit;
  const std::string& meaning =
      size.value > 0 ? effect.if_positive : effect.if_negative;
  if (meaning.empty()) return Format("%+.2g", size.value) + unit;
  return meaning + Format(" by %.2g", std::abs(size.value)) + unit;
}

// " or payload": where else a body may be.
std::string OrAt(const FoundEffect& found, const GapDiagnosis& diagnosis) {
  std::string text;
  for (const PlacedEffect& other : found.or_at) {
    text += " or " + NameOf(*other.effect, other.joint, diagnosis);
  }
  return text;
}

}  // namespace

std::string NameOf(const Effect& effect, int joint,
                   const GapDiagnosis& diagnosis) {
  std::string text = effect.name;
  for (char& c : text) {
    if (c == '_') c = ' ';
  }
  if (joint >= 0) text += " on " + diagnosis.joints[joint].name;
  return text;
}

std::string NameOf(const FoundEffect& found, const GapDiagnosis& diagnosis) {
  return NameOf(*found.effect, found.joint, diagnosis) + OrAt(found, diagnosis);
}

// The size stands behind the place that it is of.
std::string ChangeOf(const FoundEffect& found, const GapDiagnosis& diagnosis) {
  const std::string name = NameOf(*found.effect, found.joint, diagnosis);
  if (!HasDirection(found)) return NameOf(found, diagnosis);
  const EffectEstimate& size = found.estimates[0];
  if (found.effect->nature != Effect::Nature::kParameter) {
    return name + " (" + SignedSize(*found.effect, size) + ")" +
           OrAt(found, diagnosis);
  }
  // There is more of friction or inertia; a length is larger.
  const bool is_amount = found.effect->joint_term.has_value();
  if (size.value > 0) return (is_amount ? "more " : "larger ") + name;
  return (is_amount ? "less " : "smaller ") + name;
}

bool IsUntoldByReference(const FoundEffect& found,
                         const GapDiagnosis& diagnosis) {
  return diagnosis.has_reference && !found.fitted.empty() &&
         found.effect->nature == Effect::Nature::kLaw &&
         !found.in_reference.IsTold();
}

bool IsTakenOff(const FoundEffect& found) {
  return IsCarriedBody(*found.effect) && IsSignKnown(found) &&
         found.estimates[0].value < 0;
}

std::string SinceWhat(const GapDiagnosis& diagnosis) {
  const bool is_calibrations = diagnosis.calibrations_logs ==
                               GapDiagnosis::CalibrationsLogs::kAreTheReference;
  if (diagnosis.has_reference && !is_calibrations) return "the reference";
  return diagnosis.has_calibration ? "the calibration" : "";
}

bool IsConfident(double probability) { return probability >= .8; }

}  // namespace armcal
