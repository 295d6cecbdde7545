#include "calib/closed_loop/commanded_reference.h"

#include <algorithm>
#include <vector>

#include "model/dynamics/motion_columns.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// Before a log's first row and after its last the command goes on at their
// speed: logs need not begin at rest.
ReferencePoint PointAt(const ReferenceMotion& motion, double t) {
  const double nearest = std::clamp(t, 0., motion.duration);
  ReferencePoint point = motion.at(nearest);
  if (nearest == t) return point;
  point.q += (t - nearest) * point.qd;
  point.qdd.setZero();
  return point;
}

}  // namespace

CommandedReference::CommandedReference(const Robot& known,
                                       Feedforward feedforward,
                                       const CommandedLog& log)
    : known_(known),
      feedforward_(feedforward),
      dynamics_(known),
      motion_(CommandedMotion(log)) {}

// The feedforward's rate is a central difference over 2 ms, which is needed for
// its derivative by the delay.
ReferenceSeries CommandedReference::At(double begin, double period, long count,
                                       double delay) const {
  constexpr double kAhead = 1e-3;  // s, for the feedforward's rate
  const int n = known_.num_joints();
  ReferenceSeries at;
  MatrixXd q[3], qd[3], qdd[3];  // before, at and after
  for (int k = 0; k < 3; ++k) {
    if (k != 1 && feedforward_ == Feedforward::kNone) continue;
    q[k].resize(count, n);
    qd[k].resize(count, n);
    qdd[k].resize(count, n);
    for (long i = 0; i < count; ++i) {
      const double t = begin + static_cast<double>(i) * period - delay;
      const ReferencePoint point = PointAt(motion_, t + (k - 1) * kAhead);
      q[k].row(i) = point.q;
      qd[k].row(i) = point.qd;
      qdd[k].row(i) = point.qdd;
    }
  }
  at.feedforward = at.feedforward_rate = MatrixXd::Zero(count, n);
  if (feedforward_ != Feedforward::kNone) {
    at.feedforward = FeedforwardTorque(q[1], qd[1], qdd[1]);
    at.feedforward_rate = (FeedforwardTorque(q[2], qd[2], qdd[2]) -
                           FeedforwardTorque(q[0], qd[0], qdd[0])) /
                          (2 * kAhead);
  }
  at.q = q[1];
  at.qd = qd[1];
  at.qdd = qdd[1];
  return at;
}

MatrixXd CommandedReference::FeedforwardTorque(const MatrixXd& q,
                                               const MatrixXd& qd,
                                               const MatrixXd& qdd) const {
  const bool holds = feedforward_ == Feedforward::kGravity;
  const MatrixXd rest = MatrixXd::Zero(q.rows(), q.cols());
  MatrixXd torque(q.rows(), q.cols());
  std::vector<double*> columns;
  for (int j = 0; j < q.cols(); ++j) columns.push_back(torque.col(j).data());
  dynamics_.Torque({q, holds ? rest : qd, holds ? rest : qdd, {}}, q.rows(),
                   columns.data());
  for (int j = 0; !holds && j < q.cols(); ++j) {
    const Joint& joint = known_.links[j].joint;
    torque.col(j) += joint.armature * qdd.col(j) + joint.viscous * qd.col(j);
  }
  return torque;
}

}  // namespace armcal
