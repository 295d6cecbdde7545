#pragma once

#include <optional>
#include <vector>

#include "model/dynamics/geometry_knowledge.h"
#include "model/dynamics/joint_term.h"
#include "model/log_files/time_range.h"
#include "model/text/progress.h"
#include "problems/identification.h"
#include "problems/robust_loss.h"

namespace armcal {

enum class LinearSolver {
  kWeighted,  // all equations, each joint's divided by its noise
  kBatch,     // (2.25): all equations as they are
  kRecursive  // (2.28): joint by joint, from the last to the first
};

struct LinearCalibrationOptions {
  GeometryKnowledge geometry = GeometryKnowledge::kKnown;
  std::vector<JointTerm> joint_terms = {JointTerm::kViscous,
                                        JointTerm::kCoulomb, JointTerm::kOffset,
                                        JointTerm::kArmature};
  // Given: the same transition of Coulomb friction for all joints, or each
  // joint's own; else each joint's is fitted.
  std::optional<CoulombTransition> transition;
  std::vector<CoulombTransition> joint_transitions;
  Identification identification = Identification::kWeak;
  // Length of the weak form's test functions, s. Not given: DefaultWindow; 0.5
  // without a bandwidth.
  std::optional<double> window_s;
  std::vector<TimeRange> intervals;  // of the integral model
  double interval_s = 0.5;
  Quadrature quadrature = Quadrature::kTrapezoid;
  LinearSolver solver = LinearSolver::kWeighted;
  // Of the weighted solver; squared in any case where a joint has fewer
  // equations than twice the parameters. Not given: Huber's. Any but squared
  // also takes gross errors out of the torque samples.
  std::optional<RobustLoss> loss;
  // Cutoff for positions, differential rows and residuals, Hz; 0: none.
  // Not given: DefaultBandwidth.
  std::optional<double> bandwidth_hz;
  Progress progress;
};

}  // namespace armcal
