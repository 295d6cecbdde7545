#include "model/dynamics/drive_law.h"

#include <algorithm>
#include <cmath>

namespace armcal {

DriveOutput Drive(const DriveLaw& law, const DriveInput& at, double integral) {
  DriveOutput out;
  const double error = at.q_ref - at.q;
  double w = law.velocity_feedforward * at.qd_ref + law.position_gain * error;
  out.velocity_limited = std::abs(w) >= law.velocity_limit;
  w = std::clamp(w, -law.velocity_limit, law.velocity_limit);
  const double torque =
      at.feedforward + law.kp * error + law.kd * (w - at.v) + integral;
  const double rate = law.ki * error + law.velocity_ki * (w - at.v);
  out.velocity_error = w - at.v;
  out.torque_limited = std::abs(torque) >= law.torque_limit;
  out.integral_stands = out.torque_limited && torque * rate > 0;
  if (!out.integral_stands) out.integral_rate = rate;
  out.torque = std::clamp(torque, -law.torque_limit, law.torque_limit);
  return out;
}

DriveSlopes SlopesOf(const DriveLaw& law, const DriveOutput& out) {
  DriveSlopes slopes;
  slopes.acts = out.torque_limited ? 0 : 1;
  slopes.integrates = out.integral_stands ? 0 : 1;
  slopes.follows = out.velocity_limited ? 0 : 1;
  const double gain = slopes.follows * law.position_gain;
  slopes.by_q = law.kp + law.kd * gain;
  slopes.by_v = law.kd;
  slopes.rate_by_q = law.ki + law.velocity_ki * gain;
  slopes.rate_by_v = law.velocity_ki;
  return slopes;
}

const std::vector<DriveParameter>& DriveParameters() {
  using L = DriveLaw;
  constexpr DriveKind kPd = DriveKind::kPd, kP = DriveKind::kP,
                      kCascade = DriveKind::kCascade;
  static const std::vector<DriveParameter> parameters = {
      {"kp", "N m/rad", "N/m", &L::kp, {kPd, kP}},
      {"kd", "N m s/rad", "N s/m", &L::kd, {kPd, kP, kCascade}},
      {"ki", "N m/(rad s)", "N/(m s)", &L::ki, {kPd}},
      {"position_gain", "1/s", "1/s", &L::position_gain, {kCascade}},
      {"velocity_ki", "N m/rad", "N/m", &L::velocity_ki, {kCascade}},
      {"velocity_feedforward",
       "1",
       "1",
       &L::velocity_feedforward,
       {kPd, kCascade}},
      {"velocity_limit", "rad/s", "m/s", &L::velocity_limit, {kCascade}},
      {"torque_limit", "N m", "N", &L::torque_limit, {kPd, kP, kCascade}},
      {"lag", "s", "s", &L::lag, {kPd, kP, kCascade}},
  };
  return parameters;
}

bool HasParameter(DriveKind kind, const DriveParameter& parameter) {
  const auto& kinds = parameter.kinds;
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

const char* DriveKindName(DriveKind kind) {
  switch (kind) {
    case DriveKind::kPd:
      return "pd";
    case DriveKind::kP:
      return "p";
    case DriveKind::kCascade:
      return "cascade";
  }
  return "";
}

}  // namespace armcal
