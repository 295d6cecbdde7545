#include "model/dynamics/motion_track.h"

#include <algorithm>

namespace armcal {

void MotionTrack::SetMotion(const Motion& motion) {
  const int samples = motion.size();
  t = Eigen::VectorXd::LinSpaced(samples, motion.t0, motion.time(samples - 1));
  position = motion.q.transpose();
  velocity = motion.qd.transpose();
}

void MotionTrack::At(int k, ArmInstant* instant) const {
  instant->t = t[k];
  instant->position = position.col(k);
  instant->velocity = velocity.col(k);
  instant->link_position = position.col(k);
  instant->link_velocity = velocity.col(k);
  instant->load = load.col(k);
  instant->temperature = warmth.col(k);
  if (deflection.size() == 0) return;
  instant->link_position -= deflection.col(k);
  instant->link_velocity -= deflection_rate.col(k);
}

void MotionTrack::Between(int k, double share, ArmInstant* instant) const {
  instant->t = t[k] + share * (t[k + 1] - t[k]);
  InterpolateColumns(position, k, share, &instant->position);
  InterpolateColumns(velocity, k, share, &instant->velocity);
  InterpolateColumns(load, k, share, &instant->load);
  InterpolateColumns(warmth, k, share, &instant->temperature);
  instant->link_position = instant->position;
  instant->link_velocity = instant->velocity;
  if (deflection.size() == 0) return;
  for (const int i : {k, k + 1}) {
    const double part = i == k ? 1 - share : share;
    instant->link_position -= part * deflection.col(i);
    instant->link_velocity -= part * deflection_rate.col(i);
  }
}

void InterpolateColumns(const Eigen::MatrixXd& x, int k, double share,
                        Eigen::VectorXd* at) {
  const int last = static_cast<int>(x.cols()) - 1;
  const int before = std::max(k - 1, 0), next = std::min(k + 1, last);
  const int after = std::min(k + 2, last);
  const double s = share, r = 1 - share;
  // Slopes at k and next, per step, are one-sided at the ends.
  const double a = s * r * r / (next > before ? next - before : 1);
  const double b = -s * s * r / (after > k ? after - k : 1);
  const double of_this = r * r * (1 + 2 * s), of_next = s * s * (1 + 2 * r);
  const Eigen::Index rows = x.rows();
  at->resize(rows);
  // Columns are short: expressions of them would take longer than their sums.
  const double* const first = x.data();
  const double* const here = first + k * rows;
  const double* const ahead = first + next * rows;
  const double* const behind = first + before * rows;
  const double* const beyond = first + after * rows;
  double* const to = at->data();
  for (Eigen::Index j = 0; j < rows; ++j) {
    to[j] = of_this * here[j] + of_next * ahead[j] +
            a * (ahead[j] - behind[j]) + b * (beyond[j] - here[j]);
  }
}

}  // namespace armcal
