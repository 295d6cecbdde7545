#pragma once

#include <limits>
#include <vector>

namespace armcal {

// What a joint's drive makes of its command, once per period, on the joint
// side, e = q_ref - q:
//
//   w   = velocity_feedforward qd_ref + position_gain e   +-velocity_limit
//   tau = feedforward + kp e + kd (w - v) + integral      +-torque_limit
//   d integral / dt = ki e + velocity_ki (w - v)
//
// The integral stands still while the torque is at its limit and would be
// pushed further. The motor gives the torque behind a first-order lag, its
// current loop. All kinds of drives are settings of this one law.
struct DriveLaw {
  double kp = 0;                    // N m/rad or N/m
  double kd = 0;                    // N m s/rad or N s/m
  double ki = 0;                    // N m/(rad s) or N/(m s)
  double position_gain = 0;         // 1/s
  double velocity_ki = 0;           // N m/rad or N/m
  double velocity_feedforward = 1;  // share of the reference's velocity
  double velocity_limit = std::numeric_limits<double>::infinity();  // rad/s
  double torque_limit = std::numeric_limits<double>::infinity();    // N m or N
  double lag = 0;  // time constant of the current loop, s
};

// What a drive knows at one instant, rad or m, and per s.
struct DriveInput {
  double q_ref = 0;
  double qd_ref = 0;
  double feedforward = 0;  // N m or N
  double q = 0;
  double v = 0;  // as the drive has it
};

struct DriveOutput {
  double torque = 0;              // within its limit, before the lag, N m or N
  double integral_rate = 0;       // N m/s or N/s; 0 while it stands still
  double velocity_error = 0;      // w - v
  bool velocity_limited = false;  // w is its limit, whatever e does
  bool torque_limited = false;
  bool integral_stands = false;
};

DriveOutput Drive(const DriveLaw& law, const DriveInput& at, double integral);

// How torque and integral_rate fall as q and v rise, and 1 or 0 for what moves:
// the torque with what makes it, the integral with its rate, w with e.
struct DriveSlopes {
  double by_q = 0, by_v = 0;            // of the torque, where it acts
  double rate_by_q = 0, rate_by_v = 0;  // of the integral, where it moves
  double acts = 1, integrates = 1, follows = 1;
};

DriveSlopes SlopesOf(const DriveLaw& law, const DriveOutput& out);

enum class DriveKind {
  kPd,       // kp, kd, ki: on errors of position and velocity
  kP,        // kp, and kd as the drive's own damping
  kCascade,  // position_gain asks a PI velocity loop of kd and velocity_ki
};

// A number of the law as files name it.
struct DriveParameter {
  const char* name;
  const char* unit;         // of a revolute joint
  const char* linear_unit;  // of a prismatic one
  double DriveLaw::*value;
  std::vector<DriveKind> kinds;  // that have it
};

const std::vector<DriveParameter>& DriveParameters();
bool HasParameter(DriveKind kind, const DriveParameter& parameter);
const char* DriveKindName(DriveKind kind);  // "pd", "p", "cascade"

}  // namespace armcal
