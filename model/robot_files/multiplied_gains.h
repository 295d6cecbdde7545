#pragma once

#include "model/dynamics/drive_law.h"

namespace armcal {

// A drive's law as one PID loop on the position.
struct PidGains {
  double kp, ki, kd;
};

// kd (kc e + w - v) + velocity_ki times its integral, of which that of w - v is
// e but for a constant: gains of a cascade multiplied out, exact where
// velocity_feedforward is 1 or there is no velocity_ki.
inline PidGains MultipliedOut(const DriveLaw& law) {
  return {law.kp + law.kd * law.position_gain + law.velocity_ki,
          law.ki + law.velocity_ki * law.position_gain, law.kd};
}

}  // namespace armcal
