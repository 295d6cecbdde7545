#include "model/regressor.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Regressor::Regressor(const ProximalChain& chain,
                     const std::vector<Length>& unknown,
                     const RegressorColumns& columns)
    : num_joints_(static_cast<int>(chain.joints.size())),
      columns_(columns),
      momentum_(chain, unknown),
      momentum_rate_(chain, unknown) {
  const int n = num_joints_;
  const int m = static_cast<int>(columns.moments.size());
  P_.resize(n, m);
  D_.resize(n, m);
  P_dual_.resize(n, m);
  D_dual_.resize(n, m);
  q_dual_.resize(n);
  qd_dual_.resize(n);
}

void Regressor::Momentum(const VectorXd& q, const VectorXd& qd,
                         const VectorXd& coulomb, MatrixXd* P, MatrixXd* D) {
  momentum_.Evaluate(q, qd, columns_.moments, &P_, &D_);
  P->setZero(num_joints_, columns_.size());
  D->setZero(num_joints_, columns_.size());
  for (size_t k = 0; k < columns_.moments.size(); ++k) {
    P->col(columns_.moment_index[k]) = P_.col(k);
    D->col(columns_.moment_index[k]) = D_.col(k);
  }
  int next = 0;
  for (size_t k = 0; k < columns_.terms.size(); ++k) {
    const JointTermColumn& term = columns_.terms[k];
    const double c = term.term == JointTerm::kCoulomb ? coulomb[next++] : 0;
    (*P)(term.joint, columns_.term_index[k]) = term.P(qd[term.joint]);
    (*D)(term.joint, columns_.term_index[k]) = term.D(qd[term.joint], c);
  }
}

void Regressor::Differential(const VectorXd& q, const VectorXd& qd,
                             const VectorXd& qdd, const VectorXd& coulomb,
                             MatrixXd* U) {
  for (int i = 0; i < num_joints_; ++i) {
    q_dual_[i].value() = q[i];
    q_dual_[i].derivatives()[0] = qd[i];
    qd_dual_[i].value() = qd[i];
    qd_dual_[i].derivatives()[0] = qdd[i];
  }
  momentum_rate_.Evaluate(q_dual_, qd_dual_, columns_.moments, &P_dual_,
                          &D_dual_);
  U->setZero(num_joints_, columns_.size());
  for (size_t k = 0; k < columns_.moments.size(); ++k) {
    for (int i = 0; i <= columns_.moments[k].block; ++i) {
      (*U)(i, columns_.moment_index[k]) =
          P_dual_(i, k).derivatives()[0] - D_dual_(i, k).value();
    }
  }
  int next = 0;
  for (size_t k = 0; k < columns_.terms.size(); ++k) {
    const JointTermColumn& term = columns_.terms[k];
    const double c = term.term == JointTerm::kCoulomb ? coulomb[next++] : 0;
    (*U)(term.joint, columns_.term_index[k]) =
        term.Torque(qd[term.joint], qdd[term.joint], c);
  }
}

}  // namespace armcal
