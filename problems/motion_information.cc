#include "problems/motion_information.h"

#include <glog/logging.h>

#include <algorithm>
#include <future>
#include <thread>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Coulomb friction must depend on the velocity of its sample alone: states that
// follow a displacement have a memory, and A would no longer be a sum over
// samples that threads can share.
MotionInformation::MotionInformation(const Robot& robot,
                                     const ModelParameters& model)
    : num_parameters_(model.size()) {
  for (int j = 0; j < model.num_joints(); ++j) {
    columns_.push_back(model.row_columns(j));
  }
  const RegressorColumns columns = model.MakeRegressor().columns();
  for (const JointTermColumn& term : columns.terms) {
    if (term.term != JointTerm::kCoulomb) continue;
    CHECK(term.transition.law == CoulombTransition::Law::kVelocity);
    transitions_.push_back(term.transition);
    coulomb_joints_.push_back(term.joint);
  }
  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  for (unsigned k = 0; k < threads; ++k) {
    regressors_.push_back(model.MakeRegressor());
    gradients_.emplace_back(MakeProximalChain(robot), model.unknown_lengths(),
                            columns);
  }
}

// Calls work(thread, sample) for every sample, each of which belongs to one
// thread. Every sample writes only its own rows, so results do not depend on
// the threads.
template <typename Work>
void MotionInformation::OnAllThreads(const Work& work) {
  const int threads = static_cast<int>(regressors_.size());
  std::vector<std::future<void>> running;
  for (int k = 0; k < threads; ++k) {
    running.push_back(std::async(std::launch::async, [&, k] {
      for (int s = k; s < motion_.size(); s += threads) work(k, s);
    }));
  }
  for (std::future<void>& each : running) each.get();
}

// A = sum_j w_j U_j' U_j, U_j being joint j's rows with the columns that act on
// it: U is block upper triangular, and most products would be by zero. It is
// the Fisher information of X for independent normal errors whose variances are
// the weights' inverses. The sum over samples is taken after the threads, in
// one order.
void MotionInformation::Evaluate(const Motion& motion, const VectorXd& weight) {
  motion_ = motion;
  weight_ = weight;
  const int n = motion.num_joints();
  rows_.resize(n);
  for (int j = 0; j < n; ++j)
    rows_[j].resize(motion.size(), columns_[j].size());
  OnAllThreads([&](int thread, int s) {
    VectorXd c(transitions_.size());
    for (size_t k = 0; k < transitions_.size(); ++k) {
      c[k] = transitions_[k].C(motion_.qd(s, coulomb_joints_[k]), 0);
    }
    MatrixXd U;
    regressors_[thread].Differential(motion_.q.row(s), motion_.qd.row(s),
                                     motion_.qdd.row(s), c, &U);
    for (int j = 0; j < n; ++j) rows_[j].row(s) = U(j, columns_[j]);
  });
  A_.setZero(num_parameters_, num_parameters_);
  for (int j = 0; j < n; ++j) {
    A_(columns_[j], columns_[j]) += weight[j] * rows_[j].transpose() * rows_[j];
  }
}

VectorXd MotionInformation::Project(const MatrixXd& torque,
                                    const VectorXd& weight) const {
  VectorXd sum = VectorXd::Zero(num_parameters_);
  for (int j = 0; j < motion_.num_joints(); ++j) {
    sum(columns_[j]) += weight[j] * rows_[j].transpose() * torque.col(j);
  }
  return sum;
}

MatrixXd MotionInformation::Torque(const VectorXd& x) const {
  MatrixXd tau(motion_.size(), motion_.num_joints());
  for (int j = 0; j < motion_.num_joints(); ++j) {
    tau.col(j) = rows_[j] * x(columns_[j]);
  }
  return tau;
}

// The reverse of Evaluate. With G_A = df/dA symmetric and g_j = df/dtorque_j,
//   df/dU_j = 2 w_j U_j G_A + g_j x',
// since A = sum_j w_j U_j' U_j and torque_j = U_j x. RegressorGradient then
// carries df/dU of a sample to its q, qd and qdd without dU/dq itself, which
// has n times as many entries as U.
void MotionInformation::AddGradient(const MatrixXd& of_A, const VectorXd& x,
                                    const MatrixXd& of_torque,
                                    MotionGradient* gradient) {
  const int n = motion_.num_joints();
  std::vector<MatrixXd> G(n);
  for (int j = 0; j < n; ++j) {
    const MatrixXd own = of_A(columns_[j], columns_[j]);
    G[j] = 2 * weight_[j] * rows_[j] * own +
           of_torque.col(j) * x(columns_[j]).transpose();
  }
  OnAllThreads([&](int thread, int s) {
    MatrixXd weights = MatrixXd::Zero(n, num_parameters_);
    for (int j = 0; j < n; ++j) weights(j, columns_[j]) = G[j].row(s);
    VectorXd of_q = VectorXd::Zero(n), of_qd = of_q, of_qdd = of_q;
    gradients_[thread].Add(motion_.q.row(s), motion_.qd.row(s),
                           motion_.qdd.row(s), weights, &of_q, &of_qd, &of_qdd);
    gradient->q.row(s) += of_q;
    gradient->qd.row(s) += of_qd;
    gradient->qdd.row(s) += of_qdd;
  });
}

}  // namespace armcal
