#include "model/dynamics/wrench_torque.h"

#include "model/dynamics/rigid_arm.h"
#include "model/signals/stiff_step.h"

namespace armcal {

AttachedPoints FollowPoints(const Robot& robot, const MotionTrack& track,
                            const Attachment& attachment) {
  RigidArm arm(robot);
  ArmTerms terms;
  AttachedPoints points{attachment, {}};
  points.at.reserve(track.size());
  for (int k = 0; k < track.size(); ++k) {
    arm.Evaluate(track.position.col(k), track.velocity.col(k), {attachment},
                 &terms);
    points.at.push_back(terms.points[0]);
  }
  return points;
}

// Takes the torque -J'w of a wrench on the point from the drives (virtual
// work). States of the law are advanced from sample to sample.
void TakeWrench(const WrenchLaw& law, const MotionTrack& track,
                const std::vector<ArmTerms::Point>& points,
                Eigen::MatrixXd* tau) {
  Eigen::VectorXd x, unused(law.num_states);
  if (law.num_states > 0) x = law.initial_state(points[0].X_WP);
  StiffStep step(law.num_states);
  PointInstant at;
  // The instant is held over a step.
  const auto rate = [&](double, const double* state, double* dx) {
    law.wrench(at, state, dx);
  };
  for (int k = 0; k < track.size(); ++k) {
    const auto& J = points[k].jacobian;
    at.t = track.t[k];
    at.X_WP = points[k].X_WP;
    at.w_WP = J.topRows<3>() * track.velocity.col(k);
    at.v_WP = J.bottomRows<3>() * track.velocity.col(k);
    if (k > 0 && law.num_states > 0) {
      step.Advance(rate, track.t[k - 1], track.t[k] - track.t[k - 1], &x);
    }
    const Wrench wrench = law.wrench(at, x.data(), unused.data());
    if (wrench.force.isZero(0) && wrench.moment.isZero(0)) continue;
    tau->row(k) -= wrench.moment.transpose() * J.topRows<3>() +
                   wrench.force.transpose() * J.bottomRows<3>();
  }
}

}  // namespace armcal
