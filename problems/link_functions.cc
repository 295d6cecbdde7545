#include "problems/link_functions.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = 1e-5;  // m or rad

}  // namespace

VectorXd StackInertials(const Robot& robot) {
  VectorXd V(10 * robot.num_joints());
  for (int i = 0; i < robot.num_joints(); ++i) {
    V.segment<10>(10 * i) = robot.links[i].inertial.ToVector();
  }
  return V;
}

LinkFunctions::LinkFunctions(const Robot& robot,
                             const std::vector<JointTermColumn>& terms,
                             const ArmGeometry& geometry,
                             const std::vector<int>& refined)
    : terms_(terms),
      regressor_(geometry.ApplyTo(robot)),
      inertia_(StackInertials(robot)),
      coulomb_(terms),
      columns_(10 * robot.num_joints() +
               static_cast<int>(terms.size() + refined.size())) {
  for (const int k : refined) {
    ArmGeometry changed = geometry;
    VectorXd values = geometry.Values();
    values[k] += kStep;
    changed.SetValues(values);
    const Robot plus = changed.ApplyTo(robot);
    values[k] -= 2 * kStep;
    changed.SetValues(values);
    perturbed_.push_back(
        {LinkRegressor(plus), LinkRegressor(changed.ApplyTo(robot))});
  }
}

void LinkFunctions::Enter(const Trajectory& trajectory) {
  trajectory_ = &trajectory;
  states_ = coulomb_.Follow(trajectory);
}

bool LinkFunctions::Useless(int sample) const {
  return coulomb_.size() > 0 && trajectory_->standstill[sample];
}

void LinkFunctions::Momentum(int sample, MatrixXd* P, MatrixXd* D) {
  const VectorXd q = trajectory_->q.row(sample);
  const VectorXd qd = trajectory_->qd.row(sample);
  const int n = regressor_.num_joints();
  MatrixXd P_links, D_links;
  regressor_.Momentum(q, qd, &P_links, &D_links);
  P->setZero(n, columns_);
  D->setZero(n, columns_);
  P->leftCols(10 * n) = P_links;
  D->leftCols(10 * n) = D_links;
  int column = 10 * n, coulomb = 0;
  for (const JointTermColumn& term : terms_) {
    const int j = term.joint;
    const double c =
        term.term == JointTerm::kCoulomb ? states_(sample, coulomb++) : 0;
    (*P)(j, column) = term.P(qd[j]);
    (*D)(j, column++) = term.D(qd[j], c);
  }
  VectorXd P_plus, D_plus, P_minus, D_minus;
  for (Perturbed& arm : perturbed_) {
    arm.plus.Momentum(q, qd, inertia_, &P_plus, &D_plus);
    arm.minus.Momentum(q, qd, inertia_, &P_minus, &D_minus);
    P->col(column) = (P_plus - P_minus) / (2 * kStep);
    D->col(column++) = (D_plus - D_minus) / (2 * kStep);
  }
}

}  // namespace armcal
