#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "calib/logs/log_set.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"
#include "model/signals/harmonic_basis.h"
#include "problems/excitation_criterion.h"
#include "problems/motion_design.h"

namespace armcal {

struct ExcitationOptions {
  double duration_s = 20;
  int periods = 1;  // that the duration holds
  int harmonics = 10;
  double rate_hz = 100;  // of the log that will be recorded
  ExcitationCriterion criterion = ExcitationCriterion::kD;
  MotionLimits limits;
  Workspace workspace;
  Eigen::VectorXd torque_noise;  // of a sample, per joint, N m or N
  int starts = 40;  // random motions, of which the best is improved
  std::uint64_t seed = 0;
  Progress progress;
};

// A designed motion.
struct Excitation {
  HarmonicBasis basis{1, 2};
  Eigen::MatrixXd numbers;  // of the basis, per joint
  double criterion = 0;     // EvaluateCriterion's
  double start = 0;         // of the best random motion
  bool converged = false;
  std::string reason;
  int iterations = 0;
  Eigen::VectorXd stddev;  // of all quantities, predicted
  double used = 0;         // share of the limits, at 1 kHz
  double clearance = 0;    // m, least distance in the workspace, at 1 kHz
};

// The motion within the limits that makes `quantities`, which the parameters of
// `model` follow from, as certain as possible: random motions, the best of them
// improved by L-BFGS with logarithmic barriers. `model` is of `robot`, whose
// inertia gives the torques. Not converged and without numbers where no motion
// within the limits tells all quantities.
Excitation DesignExcitation(const Robot& robot, const ModelParameters& model,
                            const DesignQuantities& quantities,
                            const ExcitationOptions& options);

// A random motion of this basis, as large as the limits and the workspace
// allow; the torques of parameters x count. Empty where its centre is not
// clear.
Eigen::MatrixXd RandomNumbers(const HarmonicBasis& basis, const Motion& units,
                              const MotionBounds& bounds,
                              const Eigen::VectorXd& x, std::uint64_t seed,
                              MotionInformation* information);

// Makes a motion smaller about its constant, by a factor at a time, until it is
// within bounds. False where it never is.
bool ShrinkWaves(const Motion& units, const MotionBounds& bounds,
                 const Eigen::VectorXd& x, double factor,
                 MotionInformation* information, Eigen::MatrixXd* numbers);

// Sets used and clearance of a motion, at 1 kHz.
void CheckBounds(const ExcitationOptions& options, const Eigen::VectorXd& x,
                 MotionInformation* information, Excitation* motion);

}  // namespace armcal
