#include "calib/diagnose/candidates/line_of_motion.h"

#include <algorithm>
#include <vector>

#include "calib/diagnose/candidates/search.h"
#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A joint's recorded torque and what the file has of it, gravity and inertia,
// of a log's thinned samples, or of all (-1): columns. Other rows stay 0.
MatrixXd PartsOf(const Robot& robot, const GapRows& rows, int joint, int log) {
  MatrixXd parts = MatrixXd::Zero(rows.num_thin(), 3);
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    const GapSegment& segment = rows.segments()[i];
    if (log >= 0 && segment.log != log) continue;
    const Motion& motion = segment.motion;
    const MatrixXd tau = rows.Thin(s, segment.tau.col(joint));
    const MatrixXd q = rows.Pick(s, motion.q), qd = rows.Pick(s, motion.qd),
                   qdd = rows.Pick(s, motion.qdd);
    for (int k = 0; k < q.rows(); ++k) {
      const double gravity = GravityTorque(robot, q.row(k))[joint];
      const double all =
          InverseDynamics(robot, q.row(k), qd.row(k), qdd.row(k))[joint];
      parts.row(rows.thin_begin(s) + k) << tau(k, 0), gravity, all - gravity;
    }
  }
  return parts;
}

}  // namespace

bool IsLineOfMotion(const Robot& robot, const GapRows& rows, int joint, int log,
                    const VectorXd& swing, double frequency) {
  const MatrixXd parts = PartsOf(robot, rows, joint, log);
  std::vector<int> used;
  for (const int sample : rows.SampleOfRow(joint)) {
    const int owner = rows.segments()[rows.SegmentOf(sample)].log;
    if (log < 0 || owner == log) used.push_back(sample);
  }
  if (used.empty()) return false;
  const auto size = static_cast<Eigen::Index>(used.size());
  VectorXd t(size), v(size);
  MatrixXd model(size, 3);
  for (Eigen::Index k = 0; k < size; ++k) {
    t[k] = rows.thin_time(rows.SegmentOf(used[k]), used[k]);
    v[k] = swing[used[k]];
    model.row(k) = parts.row(used[k]);
  }
  model.col(0) -= v;
  model.rowwise() -= model.colwise().mean().eval();
  double largest = 0;
  for (int part = 0; part < 3; ++part) {
    largest = std::max(largest, AmplitudeAt(model.col(part), t, frequency));
  }
  return largest > AmplitudeAt(v, t, frequency);
}

}  // namespace armcal
