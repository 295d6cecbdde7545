#include "problems/motion_design.h"

#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MotionDesign::MotionDesign(const Motion& units, const MotionBounds& bounds,
                           const DesignQuantities& quantities,
                           ExcitationCriterion criterion,
                           const VectorXd& weight, const VectorXd& x,
                           MotionInformation* information)
    : units_(units),
      bounds_(bounds),
      quantities_(quantities),
      criterion_(criterion),
      weight_(weight),
      x_(x),
      information_(information) {}

int MotionDesign::NumParameters() const {
  return static_cast<int>(units_.q.cols() * weight_.size());
}

// cost = log criterion(A(motion)) + barrier sum of -log(slack of each limit).
// This is an interior-point method (Boyd & Vandenberghe 2004, Convex
// Optimization, 11.3): the caller lowers `barrier` step by step, and every
// motion on the way keeps all limits. No value means that the line search has
// to go back.
//
// The gradient goes backwards by the chain rule: cost -> (A, torque) -> (q, qd,
// qdd) of each sample -> the numbers p. Motion is linear in p, q = B_q p, so
// the last step is B_q' dq + B_qd' dqd + B_qdd' dqdd. The price is a few times
// that of the value, however many numbers there are; differences would cost one
// value for each of them.
bool MotionDesign::Evaluate(const double* numbers, double* cost,
                            double* gradient) const {
  const Eigen::Map<const MatrixXd> p(numbers, units_.q.cols(), weight_.size());
  const Motion motion = Combine(units_, p);
  information_->Evaluate(motion, weight_);
  const MatrixXd torque = information_->Torque(x_);
  MotionGradient of_motion(motion);
  MatrixXd of_torque = MatrixXd::Zero(torque.rows(), torque.cols());
  const double barrier = LimitBarrier(bounds_.limits, motion, torque, barrier_,
                                      &of_motion, &of_torque) +
                         bounds_.workspace->Barrier(motion.q, bounds_.clearance,
                                                    barrier_, &of_motion);
  if (!std::isfinite(barrier)) return false;
  MatrixXd of_A;
  const std::optional<double> value =
      EvaluateCriterion(criterion_, quantities_, information_->A(), &of_A);
  if (!value) return false;
  *cost = *value + barrier_ * barrier;
  if (gradient == nullptr) return true;
  information_->AddGradient(of_A, x_, of_torque, &of_motion);
  Eigen::Map<MatrixXd>(gradient, p.rows(), p.cols()) =
      units_.q.transpose() * of_motion.q +
      units_.qd.transpose() * of_motion.qd +
      units_.qdd.transpose() * of_motion.qdd;
  return true;
}

}  // namespace armcal
