#pragma once

#include <vector>

#include "calib/linear/identifiability.h"
#include "calib/linear/log_factors.h"
#include "calib/linear/residual_pass.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"

namespace armcal {

// One log's equation of one joint that carries no drive torque worth the name:
// the arm swings freely there, the equation is homogeneous and knows no scale.
struct UnpoweredJoint {
  int log;
  int joint;
  double torque_rms;  // N m or N
};

struct UsedEquations {
  EquationMask used;
  // Joints that no log powers: their equations count, with noise that is not
  // re-estimated.
  std::vector<bool> frozen;
  std::vector<UnpoweredJoint> unpowered;
};

UsedEquations AllEquations(const LogFactors& factors, int num_joints);

// Leaves out equations that carry no drive torque worth the name, by the robot
// file's inertia (below a twentieth of the terms) or by the logs' own solution
// (below a tenth), unless the joint has no others. Left to themselves, the
// equations of an arm that swings freely are solved best by an arm without
// mass.
UsedEquations FindUsedEquations(const LogFactors& factors,
                                const ModelParameters& parameters,
                                const ReferenceScale& reference);

}  // namespace armcal
