#include "model/dynamics/batch_inverse_dynamics.h"

#include <glog/logging.h>

#include <algorithm>

#include "model/dynamics/regressor_plan.h"

namespace armcal {

BatchInverseDynamics::BatchInverseDynamics(const Robot& robot,
                                           const simd::Kernels& kernels)
    : plan_(
          std::make_shared<RegressorPlan>(robot, RegressorPlan::Places::kNone)),
      inertia_(10 * robot.num_joints()),
      kernels_(&kernels) {
  for (int i = 0; i < robot.num_joints(); ++i) {
    inertia_.segment<10>(10 * i) = robot.links[i].inertial.ToVector();
  }
}

// The inertias of a path's links, stacked. Links that an earlier path has have
// no body.
Eigen::VectorXd BatchInverseDynamics::InertiaOf(const LinkPath& path) const {
  Eigen::VectorXd inertia = Eigen::VectorXd::Zero(10 * path.links.size());
  for (size_t k = path.first_own; k < path.links.size(); ++k) {
    inertia.segment<10>(10 * k) = inertia_.segment<10>(10 * path.links[k]);
  }
  return inertia;
}

// The torque is linear in the bodies, so that a robot that branches is the sum
// of its chains from the base to each tip, each body in one of them.
void BatchInverseDynamics::Torque(const MotionColumns& motion, long count,
                                  double* const* tau) const {
  CHECK_EQ(motion.qdd.size(), plan_->num_joints());
  const simd::ChainMotion all = {motion.q.data(), motion.qd.data(),
                                 motion.qdd.data()};
  if (plan_->paths().size() == 1) {
    kernels_->inverse_dynamics(plan_->paths()[0].chain, inertia_.data(), all,
                               count, tau);
    return;
  }
  for (int j = 0; j < plan_->num_joints(); ++j) std::fill_n(tau[j], count, 0.);
  auto path = plan_->paths().begin();
  Eigen::MatrixXd of_path(count, plan_->num_joints());
  plan_->ForEachPath(
      all, tau, nullptr, [&](auto& chain, auto& some, auto* to, auto*) {
        std::vector<double*> columns;
        for (int i = 0; i < chain.num_links; ++i) {
          columns.push_back(of_path.col(i).data());
        }
        kernels_->inverse_dynamics(chain, InertiaOf((path++)->links).data(),
                                   some, count, columns.data());
        for (int i = 0; i < chain.num_links; ++i) {
          Eigen::Map<Eigen::VectorXd>(to[i], count) += of_path.col(i);
        }
      });
}

}  // namespace armcal
