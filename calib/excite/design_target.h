#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/excite/design_kinds.h"
#include "calib/linear/identifiability.h"
#include "calib/refine/arm_unknowns.h"
#include "model/dynamics/model_parameters.h"
#include "model/robot/robot.h"
#include "problems/excitation_criterion.h"

namespace armcal {

// Quantities of a design with what they are called.
struct NamedQuantities {
  DesignQuantities design;
  std::vector<std::string> names, units;
  Eigen::VectorXd nominal;
};

// The quantities of a target that the parameters of `model` follow from at the
// robot file's values. `known`: information about the model parameters
// beforehand (m x m). Model parameters are measured by their torque in
// `reference`, physical ones and lengths by their prior in `trust`. Lengths are
// those that `model` takes as unknown; `terms` what joints add to the links'
// torque.
NamedQuantities MakeDesignQuantities(const Robot& robot,
                                     const ModelParameters& model,
                                     const std::vector<JointTerm>& terms,
                                     DesignTarget target, const ArmTrust& trust,
                                     const ReferenceScale& reference,
                                     const Eigen::MatrixXd& known);

// How much of X a unit of torque is: standard deviations of parameters in these
// units are shares of the joints' torque.
Eigen::VectorXd TorqueScale(const ReferenceScale& reference);

}  // namespace armcal
