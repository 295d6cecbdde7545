#include "problems/torque_sensitivity.h"

#include <cmath>
#include <vector>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// rad or rad/s: the torque is smooth there and quadratic in the velocity, so
// that a forward difference is right to about 1e-6.
constexpr double kStep = 1e-6;
constexpr double kWidthFactor = 1.05;

std::vector<JointTermColumn> Scaled(std::vector<JointTermColumn> columns,
                                    double factor) {
  for (JointTermColumn& c : columns) c.transition.width *= factor;
  return columns;
}

}  // namespace

TorqueSensitivity::TorqueSensitivity(const ModelParameters& parameters)
    : regressor_(parameters.MakeRegressor()),
      coulomb_(regressor_.columns().terms),
      wider_(Scaled(regressor_.columns().terms, kWidthFactor)),
      narrower_(Scaled(regressor_.columns().terms, 1 / kWidthFactor)) {
  const RegressorColumns& columns = regressor_.columns();
  for (size_t k = 0; k < columns.terms.size(); ++k) {
    if (columns.terms[k].term != JointTerm::kCoulomb) continue;
    widths_.push_back(columns.terms[k]);
    width_parameter_.push_back(columns.term_index[k]);
    width_joint_.push_back(columns.terms[k].joint);
  }
}

void TorqueSensitivity::Enter(const Trajectory& trajectory) {
  trajectory_ = &trajectory;
  states_ = coulomb_.Follow(trajectory);
  wider_states_ = wider_.Follow(trajectory);
  narrower_states_ = narrower_.Follow(trajectory);
}

void TorqueSensitivity::Regress(int sample, MatrixXd* U) {
  regressor_.Differential(trajectory_->q.row(sample),
                          trajectory_->qd.row(sample),
                          trajectory_->qdd.row(sample), states_.row(sample), U);
}

VectorXd TorqueSensitivity::Torque(const VectorXd& q, const VectorXd& qd,
                                   const VectorXd& qdd, const VectorXd& c,
                                   const VectorXd& x) {
  regressor_.Differential(q, qd, qdd, c, &U_);
  return U_ * x;
}

// T = [d tau/dq, d tau/dqd, d tau/dqdd] at fixed x. Positions and velocities go
// by forward differences, 2 n + 1 evaluations of U x. The torque is affine in
// the acceleration, and d tau/dqdd is the mass matrix, whose column j is the
// momentum at the unit velocity of joint j: no difference of large numbers is
// taken. Friction by velocity, c = tanh(qd / width), is held during the
// differences, as a step may be no small part of a width, and adds
//   x_c dc/dqd = x_c (1 - c^2) / width
// by itself.
void TorqueSensitivity::Differentiate(int sample, const VectorXd& x,
                                      MatrixXd* T) {
  VectorXd q = trajectory_->q.row(sample), qd = trajectory_->qd.row(sample);
  const VectorXd qdd = trajectory_->qdd.row(sample);
  const VectorXd c = states_.row(sample);
  const Eigen::Index n = q.size();
  T->resize(n, 3 * n);
  const VectorXd tau = Torque(q, qd, qdd, c, x);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double position = q[j], velocity = qd[j];
    q[j] += kStep;
    T->col(j) = (Torque(q, qd, qdd, c, x) - tau) / kStep;
    q[j] = position;
    qd[j] += kStep;
    T->col(n + j) = (Torque(q, qd, qdd, c, x) - tau) / kStep;
    qd[j] = velocity;
  }
  MatrixXd P, D;  // the momentum is the mass matrix times the velocity
  for (Eigen::Index j = 0; j < n; ++j) {
    regressor_.Momentum(q, VectorXd::Unit(n, j), c, &P, &D);
    T->col(2 * n + j) = P * x;
  }
  for (int w = 0; w < num_widths(); ++w) {
    const CoulombTransition& t = widths_[w].transition;
    if (t.law != CoulombTransition::Law::kVelocity) continue;
    const int j = width_joint_[w];
    (*T)(j, n + j) += x[width_parameter_[w]] * (1 - c[w] * c[w]) / t.width;
  }
}

// A central difference in log(width), between states 5 % wider and narrower.
// Both are followed along the whole log: the displacement law has a memory, so
// that its derivative cannot be had from one sample.
double TorqueSensitivity::WidthDerivative(int sample, int w) const {
  return (wider_states_(sample, w) - narrower_states_(sample, w)) /
         (2 * std::log(kWidthFactor));
}

}  // namespace armcal
