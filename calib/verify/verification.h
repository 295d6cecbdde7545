#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "model/robot/robot.h"

namespace armcal {

struct VerificationOptions {
  int random_states = 1000;
  // Of a log's states at most this many, evenly spread.
  int log_states = 1000;
  std::uint64_t seed = 1;
  double swing_s = 10;  // a tenth or a hundredth where that cannot be followed
  Progress progress;
};

// One figure against its bar. A value that is not finite does not pass, unless
// it is optional and NaN: then nothing was compared.
struct VerificationCheck {
  std::string name;
  double value;
  double threshold;
  bool optional = false;  // of a figure that may not be had
  bool compared() const { return !optional || value == value; }
  bool passed() const { return !compared() || value <= threshold; }
};

// Whether our dynamics of a robot are those of Simbody, which shares no code
// with ours, and whether the robot can be simulated at all.
//
// Relative differences are of vectors in 2-norm (matrices in Frobenius'), the
// largest of all states. A torque counts as at least 1e-3 of the largest torque
// of all states, so that an arm whose gravity loads no joint is not judged by
// its rounding. Drift is the largest change of the energy in a passive swing,
// over its largest kinetic energy. NaN where nothing could be compared; what
// Simbody's integrator cannot follow and ours can is not held against a robot.
struct Verification {
  double torque_max_rel;
  double mass_matrix_max_rel;
  double gravity_max_rel;
  double energy_max_rel;
  double energy_drift_rel;      // Simbody's dynamics and integrator
  double own_energy_drift_rel;  // ours
  // Of the torque that our forward dynamics answer to, from inverse dynamics.
  double own_consistency_rel;
  int random_states = 0;
  int log_states = 0;
  double swing_s = 0;  // that was followed; 0: none
  // Why the robot cannot be simulated, a sentence each that names the link.
  std::vector<std::string> reasons;

  std::vector<VerificationCheck> Checks() const;
  bool passed() const;
};

// `log` may be null. Where Simbody refuses a link, only our own model is
// checked.
Verification VerifyDynamics(const Robot& robot,
                            const VerificationOptions& options,
                            const PreparedLogs* log);

}  // namespace armcal
