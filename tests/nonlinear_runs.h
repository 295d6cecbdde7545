#pragma once

// Simulated arms whose links differ from their robot file's, and what
// CalibrateNonlinear makes of their logs.

#include <optional>
#include <random>
#include <string>

#include "calib/linear_calibration.h"
#include "calib/nonlinear_calibration.h"
#include "tests/sample_motion.h"
#include "tests/sample_robots.h"

namespace armcal {

// A rigid body drawn from the prior: the pseudo-inertia's relative deviation
// is normal in every direction, and the body can exist.
InertialParameters DrawAround(const InertialParameters& file, double trust,
                              std::mt19937_64* random);

struct SimulatedArm {
  Robot file, truth;
};

// `trust`: how far the truth is from the file. The file knows no joint terms.
SimulatedArm MakeArm(const std::string& name, double trust,
                     std::mt19937_64* random);

constexpr CoulombTransition kTransition = {
    CoulombTransition::Law::kDisplacement, .003};

// A log of random motion, without noise.
Log MoveArm(const Robot& truth, double duration, std::mt19937_64* random);

struct NonlinearRun {
  LinearCalibration linear;
  NonlinearCalibration physical;
  std::string held_out;  // path of the log it was validated on
};

// Calibrates on one log and validates on another, both with noise of `noise`
// times the torque unless the validation log's is given.
NonlinearRun Calibrate(const SimulatedArm& arm, double noise,
                       const NonlinearCalibrationOptions& options,
                       std::mt19937_64* random,
                       GeometryKnowledge geometry = GeometryKnowledge::kKnown,
                       std::optional<double> validation_noise = {});

// The value of a parameter in `robot`: "<link>.mass", "<joint>.viscous".
double ValueIn(const Robot& robot, const std::string& name);

}  // namespace armcal
