#include "model/dynamics/regressor_gradient.h"

#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

RegressorGradient::RegressorGradient(const ProximalChain& chain,
                                     const std::vector<Length>& unknown,
                                     const RegressorColumns& columns)
    : num_joints_(static_cast<int>(chain.joints.size())),
      columns_(columns),
      momentum_(chain, unknown) {
  const auto m = static_cast<Eigen::Index>(columns.moments.size());
  P_.resize(num_joints_, m);
  D_.resize(num_joints_, m);
  q_.resize(num_joints_);
  qd_.resize(num_joints_);
}

// With p and d the sums of P and D, that of U is p_q qd + p_qd qdd - d: its
// gradient in qdd is p's in qd. `state`, `of_sum` and `of_p`: q and qd one
// after the other.
void RegressorGradient::AddDirections(const VectorXd& state,
                                      const VectorXd& qdd, const MatrixXd& G,
                                      int begin, VectorXd* of_sum,
                                      VectorXd* of_p) {
  const int n = num_joints_;
  using Numbers = Eigen::Matrix<double, kWidth, 1>;
  const auto number = [&](int k) {
    Gradient x(state[k], Numbers::Zero());
    if (k >= begin && k < begin + kWidth) x.derivatives()[k - begin] = 1;
    return x;
  };
  for (int i = 0; i < n; ++i) {
    q_[i].value() = number(i);
    q_[i].derivatives()[0] = number(n + i);
    qd_[i].value() = number(n + i);
    qd_[i].derivatives()[0] = Gradient(qdd[i], Numbers::Zero());
  }
  momentum_.Evaluate(q_, qd_, columns_.moments, &P_, &D_);
  Numbers sum = Numbers::Zero(), p = Numbers::Zero();
  for (size_t k = 0; k < columns_.moments.size(); ++k) {
    for (int i = 0; i <= columns_.moments[k].block; ++i) {
      const double g = G(i, columns_.moment_index[k]);
      sum += g * (P_(i, k).derivatives()[0].derivatives() -
                  D_(i, k).value().derivatives());
      p += g * P_(i, k).value().derivatives();
    }
  }
  const int width = std::min(kWidth, 2 * n - begin);
  of_sum->segment(begin, width) += sum.head(width);
  of_p->segment(begin, width) += p.head(width);
}

// The gradient of sum_ik G_ik U_ik in the motion, by derivatives carried
// forwards, kWidth directions at a time, through P and D; terms have it in
// closed form.
void RegressorGradient::Add(const VectorXd& q, const VectorXd& qd,
                            const VectorXd& qdd, const MatrixXd& G,
                            VectorXd* of_q, VectorXd* of_qd, VectorXd* of_qdd) {
  const int n = num_joints_;
  VectorXd state(2 * n), of_sum = VectorXd::Zero(2 * n), of_p = of_sum;
  state << q, qd;
  for (int begin = 0; begin < 2 * n; begin += kWidth) {
    AddDirections(state, qdd, G, begin, &of_sum, &of_p);
  }
  *of_q += of_sum.head(n);
  *of_qd += of_sum.tail(n);
  *of_qdd += of_p.tail(n);
  for (size_t k = 0; k < columns_.terms.size(); ++k) {
    const JointTermColumn& term = columns_.terms[k];
    const int j = term.joint;
    const double g = G(j, columns_.term_index[k]);
    switch (term.term) {
      case JointTerm::kViscous:
        (*of_qd)[j] += g;
        break;
      case JointTerm::kArmature:
        (*of_qdd)[j] += g;
        break;
      case JointTerm::kCoulomb: {
        const double width = term.transition.width;
        const double c = std::tanh(qd[j] / width);
        (*of_qd)[j] += g * (1 - c * c) / width;
        break;
      }
      case JointTerm::kOffset:
        break;
    }
  }
}

}  // namespace armcal
