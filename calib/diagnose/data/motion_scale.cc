#include "calib/diagnose/data/motion_scale.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "calib/diagnose/data/swung_joints.h"
#include "model/dynamics/joint_warmth.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Of each joint where all logs have temperatures; the longest segment tells.
std::vector<JointThermal> RecordedThermal(
    const std::vector<RecordedTorque>& torques) {
  const RecordedTorque* longest = nullptr;
  for (const RecordedTorque& torque : torques) {
    const Motion& motion = torque.motion();
    if (motion.temperature.size() == 0) return {};
    if (!longest || motion.size() > longest->motion().size()) longest = &torque;
  }
  std::vector<JointThermal> thermal;
  for (int j = 0; longest && j < longest->motion().num_joints(); ++j) {
    const FrictionPower& power = longest->friction_power();
    thermal.push_back(FitThermal(power.viscous.col(j) + power.coulomb.col(j),
                                 longest->motion().temperature.col(j),
                                 longest->motion().dt));
  }
  return thermal;
}

// Whether each joint swung freely in all logs; empty: none did.
std::vector<bool> Swinging(const Robot& robot,
                           const std::vector<GapSegment>& segments) {
  std::set<int> logs;
  for (const GapSegment& segment : segments) logs.insert(segment.log);
  std::vector<size_t> count(robot.num_joints(), 0);
  const std::vector<SwungJoint> swung = FindSwungJoints(robot, segments);
  for (const SwungJoint& one : swung) ++count[one.joint];
  if (swung.empty()) return {};
  std::vector<bool> swings;
  for (const size_t of : count) swings.push_back(of == logs.size());
  return swings;
}

}  // namespace

// What the effects of the catalogue are sized by, as the logs have it: rms
// torque, load, speed and acceleration of each joint, those of speed and
// acceleration over the time in which it moves, and the largest of them. Sums
// of squares are added segment by segment and divided by their samples once.
MotionScale ScaleOf(const GapBaseline& baseline, const GapRows& rows,
                    const std::vector<RecordedTorque>& torques) {
  const int n = rows.num_joints();
  MotionScale scale;
  scale.torque = scale.load = scale.speed = scale.top_speed = scale.top_torque =
      scale.acceleration = scale.width = VectorXd::Zero(n);
  scale.low = VectorXd::Constant(n, INFINITY);
  scale.high = -scale.low;
  double samples = 0;
  VectorXd moving = VectorXd::Zero(n);
  scale.begin = INFINITY;
  for (size_t s = 0; s < torques.size(); ++s) {
    const GapSegment& segment = rows.segments()[s];
    const Motion& motion = segment.motion;
    samples += motion.size();
    scale.begin = std::min(scale.begin, motion.time(0));
    scale.end = std::max(scale.end, motion.time(motion.size() - 1));
    for (int j = 0; j < n; ++j) {
      const auto move = (!segment.still.col(j)).cast<double>();
      moving[j] += move.sum();
      scale.torque[j] += segment.tau.col(j).squaredNorm();
      scale.load[j] += torques[s].load().col(j).squaredNorm();
      scale.speed[j] += (motion.qd.col(j).array().square() * move).sum();
      scale.acceleration[j] +=
          (motion.qdd.col(j).array().square() * move).sum();
      scale.top_speed[j] =
          std::max(scale.top_speed[j], motion.qd.col(j).cwiseAbs().maxCoeff());
      scale.top_torque[j] = std::max(
          scale.top_torque[j], motion.torque.tau.col(j).cwiseAbs().maxCoeff());
      scale.low[j] = std::min(scale.low[j], motion.q.col(j).minCoeff());
      scale.high[j] = std::max(scale.high[j], motion.q.col(j).maxCoeff());
    }
  }
  moving = moving.cwiseMax(1);
  scale.torque = (scale.torque / samples).cwiseSqrt();
  scale.load = (scale.load / samples).cwiseSqrt();
  scale.speed = scale.speed.cwiseQuotient(moving).cwiseSqrt();
  scale.acceleration = scale.acceleration.cwiseQuotient(moving).cwiseSqrt();
  for (int j = 0; j < n; ++j) {
    scale.width[j] = baseline.transitions()[j].width;
  }
  scale.swings = Swinging(baseline.robot(), rows.segments());
  scale.thermal = RecordedThermal(torques);
  return scale;
}

}  // namespace armcal
