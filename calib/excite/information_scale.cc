#include "calib/excite/information_scale.h"

#include <algorithm>

#include "calib/excite/design_target.h"
#include "calib/excite/given_information.h"
#include "calib/linear/error_density.h"
#include "model/signals/dense_solvers.h"
#include "problems/motion_limits.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ModelParameters ModelLike(const Robot& robot,
                          const LinearCalibrationOptions& options) {
  constexpr double kTransition = .05;  // rad/s or m/s
  ModelParameters::Options model;
  model.geometry = options.geometry;
  model.joint_terms = options.joint_terms;
  model.transitions.assign(robot.num_joints(),
                           {{CoulombTransition::Law::kVelocity, kTransition}});
  return {robot, model};
}

}  // namespace

InformationScale::InformationScale(const Robot& robot,
                                   const LinearCalibration& linear,
                                   const LinearCalibrationOptions& options)
    : model(ModelLike(robot, options)) {
  std::vector<std::string> assumed;
  const MotionLimits limits = LimitsOf(robot, &assumed);
  const VectorXd torque = linear.training->whole().torque_rms;
  unit = TorqueScale(MakeReferenceScale(model, limits.velocity.mean() / 2, .5,
                                        1, torque, model.Values(robot)));
  // A joint without any error, or without torque, still counts for something.
  density = ErrorDensity(linear).cwiseMax(1e-6 *
                                          std::max(1e-6, torque.squaredNorm()));
}

int InformationScale::Rank(const MatrixXd& information) const {
  const VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(
                              Scaled(information), Eigen::EigenvaluesOnly)
                              .eigenvalues();
  const double least = std::max(1., 1e-15 * values.maxCoeff());
  return static_cast<int>((values.array() >= least).count());
}

}  // namespace armcal
