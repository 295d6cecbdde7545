#include "model/drive_law.h"

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
  out.torque_limited = std::abs(torque) >= law.torque_limit;
  const bool pushes = out.torque_limited && torque * rate > 0;
  if (!pushes) out.integral_rate = rate;
  out.torque = std::clamp(torque, -law.torque_limit, law.torque_limit);
  return out;
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
