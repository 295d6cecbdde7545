#include "model/dynamics/regressor.h"

#include <glog/logging.h>

#include "model/dynamics/regressor_plan.h"
#include "model/simd/kernels.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void Point(const VectorXd& x, std::vector<const double*>* to) {
  CHECK_EQ(x.size(), to->size());
  for (size_t i = 0; i < to->size(); ++i) (*to)[i] = x.data() + i;
}

// The matrix as zeros; its rows, which have a stride of their number.
void PointToRows(int columns, MatrixXd* matrix, std::vector<double*>* rows) {
  matrix->setZero(rows->size(), columns);
  for (size_t i = 0; i < rows->size(); ++i) (*rows)[i] = matrix->data() + i;
}

}  // namespace

Regressor::Regressor(const ProximalChain& chain,
                     const std::vector<Length>& unknown,
                     const RegressorColumns& columns)
    : num_joints_(static_cast<int>(chain.joints.size())),
      columns_(columns),
      plan_(std::make_shared<RegressorPlan>(chain, unknown, columns,
                                            RegressorPlan::Places::kNumbers)),
      q_(num_joints_),
      qd_(num_joints_),
      qdd_(num_joints_),
      rows_(num_joints_),
      more_rows_(num_joints_) {}

// P and D of one state: moments by the kernel of the chain, then the joints'
// terms.
void Regressor::Momentum(const VectorXd& q, const VectorXd& qd,
                         const VectorXd& coulomb, MatrixXd* P, MatrixXd* D) {
  Point(q, &q_);
  Point(qd, &qd_);
  PointToRows(columns_.size(), P, &rows_);
  PointToRows(columns_.size(), D, &more_rows_);
  plan_->ForEachPath(
      {q_.data(), qd_.data(), nullptr}, rows_.data(), more_rows_.data(),
      [this](auto& chain, auto& motion, auto* rows, auto* more_rows) {
        simd::BestKernels().momentum_of_one(chain, motion, 0, rows, more_rows,
                                            num_joints_);
      });
  int next = 0;
  for (size_t k = 0; k < columns_.terms.size(); ++k) {
    const JointTermColumn& term = columns_.terms[k];
    const double c = term.term == JointTerm::kCoulomb ? coulomb[next++] : 0;
    (*P)(term.joint, columns_.term_index[k]) = term.P(qd[term.joint]);
    (*D)(term.joint, columns_.term_index[k]) = term.D(qd[term.joint], c);
  }
}

// U of one state, in the same order.
void Regressor::Differential(const VectorXd& q, const VectorXd& qd,
                             const VectorXd& qdd, const VectorXd& coulomb,
                             MatrixXd* U) {
  Point(q, &q_);
  Point(qd, &qd_);
  Point(qdd, &qdd_);
  PointToRows(columns_.size(), U, &rows_);
  plan_->ForEachPath({q_.data(), qd_.data(), qdd_.data()}, rows_.data(),
                     nullptr,
                     [this](auto& chain, auto& motion, auto* rows, auto*) {
                       simd::BestKernels().differential_of_one(
                           chain, motion, 0, rows, num_joints_);
                     });
  int next = 0;
  for (size_t k = 0; k < columns_.terms.size(); ++k) {
    const JointTermColumn& term = columns_.terms[k];
    const double c = term.term == JointTerm::kCoulomb ? coulomb[next++] : 0;
    (*U)(term.joint, columns_.term_index[k]) =
        term.Torque(qd[term.joint], qdd[term.joint], c);
  }
}

}  // namespace armcal
