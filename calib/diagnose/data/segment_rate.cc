#include "calib/diagnose/data/segment_rate.h"

#include <cmath>

#include "model/signals/low_pass.h"

namespace armcal {
namespace {

// What lies above half the new rate, 2.5 times the cutoff, and would appear
// below it has passed the filter (low_pass.h) with a gain of 1/(1 + 2.5^8) =
// 1/1527 at most.
constexpr double kSamplesPerPeriod = 5;

// Every m-th row; of nothing, nothing.
template <typename Rows>
void KeepRows(int m, Rows* x) {
  if (x->size() == 0) return;
  const Eigen::Index left = (x->rows() + m - 1) / m;
  for (Eigen::Index k = 1; k < left; ++k) x->row(k) = x->row(k * m).eval();
  x->conservativeResize(left, x->cols());
}

}  // namespace

void DecimateSegment(double motion_bandwidth_hz, GapSegment* segment) {
  Motion& motion = segment->motion;
  const double rate = 1 / motion.dt;
  const int m =
      static_cast<int>(rate / (kSamplesPerPeriod * motion_bandwidth_hz) +
                       1e-6);  // stamps are rounded
  if (m < 2) return;
  segment->tau = ZeroPhaseLowPass(segment->tau, rate, motion_bandwidth_hz);
  for (Eigen::MatrixXd* signal :
       {&segment->tau, &segment->position_noise, &segment->torque_noise,
        &motion.q, &motion.qd, &motion.qdd, &motion.temperature,
        &motion.torque.tau, &motion.torque_by_rate}) {
    KeepRows(m, signal);
  }
  KeepRows(m, &motion.stamp_error);
  KeepRows(m, &segment->still);
  KeepRows(m, &segment->breaks_away);
  motion.dt *= m;
}

}  // namespace armcal
