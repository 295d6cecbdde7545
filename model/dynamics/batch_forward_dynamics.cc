#include "model/dynamics/batch_forward_dynamics.h"

#include <glog/logging.h>

#include <algorithm>

#include "model/dynamics/arm_plan.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// evaluate(first sample) for every batch of `lanes`; those left over end with
// the last sample, so that they are computed in lanes too: fewer samples than
// lanes are for the caller to fill up.
template <class Evaluate>
void ForEachBatch(long count, int lanes, const Evaluate& evaluate) {
  for (long first = 0; first < count; first += lanes) {
    evaluate(std::min(first, count - lanes));
  }
}

// With the last row again and again until there are as many as lanes.
MatrixXd Filled(const MatrixXd& x, int lanes) {
  MatrixXd filled(lanes, x.cols());
  filled << x, x.bottomRows<1>().replicate(lanes - x.rows(), 1);
  return filled;
}

}  // namespace

BatchForwardDynamics::BatchForwardDynamics(const Robot& robot,
                                           const simd::Kernels& kernels)
    : plan_(std::make_shared<ArmPlan>(RolloutArm{robot, {}, {}},
                                      kernels.arms.lanes)),
      kernels_(&kernels.arms) {}

void BatchForwardDynamics::MassMatrix(const MatrixXd& q, MatrixXd* M) const {
  const int n = plan_->num_joints(), lanes = kernels_->lanes;
  CHECK_EQ(q.cols(), n);
  const long count = q.rows();
  M->resize(count, n * n);
  if (count == 0) return;
  if (count < lanes) {
    MatrixXd all;
    MassMatrix(Filled(q, lanes), &all);
    *M = all.topRows(count);
    return;
  }
  ForEachBatch(count, lanes, [&](long first) {
    kernels_->terms(plan_->constants(), q.data() + first, nullptr, count,
                    M->data() + first, nullptr);
  });
}

void BatchForwardDynamics::Acceleration(const MatrixXd& q, const MatrixXd& qd,
                                        const MatrixXd& tau,
                                        MatrixXd* qdd) const {
  const int n = plan_->num_joints(), lanes = kernels_->lanes;
  const long count = q.rows();
  for (const MatrixXd* x : {&q, &qd, &tau}) {
    CHECK(x->rows() == count && x->cols() == n);
  }
  qdd->resize(count, n);
  if (count == 0) return;
  if (count < lanes) {
    MatrixXd all;
    Acceleration(Filled(q, lanes), Filled(qd, lanes), Filled(tau, lanes), &all);
    *qdd = all.topRows(count);
    return;
  }
  ForEachBatch(count, lanes, [&](long first) {
    kernels_->acceleration(plan_->constants(), q.data() + first,
                           qd.data() + first, tau.data() + first, count,
                           qdd->data() + first);
  });
}

}  // namespace armcal
