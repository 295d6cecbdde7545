#include "problems/motion_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// |x - centre| <= reach for one quantity of one joint.
struct Band {
  double centre, reach;
  double Share(double x) const {
    return std::isfinite(reach) ? (x - centre) / reach : 0;
  }
};

Band PositionBand(const MotionLimits& limits, int j) {
  return {(limits.upper[j] + limits.lower[j]) / 2,
          (limits.upper[j] - limits.lower[j]) / 2};
}

double LargestShare(const Band& band, const VectorXd& x) {
  return std::max(std::abs(band.Share(x.maxCoeff())),
                  std::abs(band.Share(x.minCoeff())));
}

// The logarithmic barrier of one quantity over all samples, with u = (x -
// centre) / reach:
//   sum_s -log(1 - u_s^2),   d/dx = 2 u / (1 - u^2) / reach.
// At or beyond the limit it is infinite, not NaN, and the motion is refused.
double AddBand(const Band& band, const VectorXd& x, double factor,
               Eigen::Ref<VectorXd> gradient) {
  if (!std::isfinite(band.reach)) return 0;
  double sum = 0;
  for (Eigen::Index s = 0; s < x.size(); ++s) {
    const double share = band.Share(x[s]);
    const double slack = 1 - share * share;
    if (!(slack > 0)) return std::numeric_limits<double>::infinity();
    sum -= std::log(slack);
    gradient[s] += factor * 2 * share / slack / band.reach;
  }
  return sum;
}

}  // namespace

MotionLimits MotionLimits::Within(double share) const {
  MotionLimits inner = *this;
  const VectorXd centre = (upper + lower) / 2;
  inner.lower = centre + share * (lower - centre);
  inner.upper = centre + share * (upper - centre);
  inner.velocity *= share;
  inner.acceleration *= share;
  inner.effort *= share;
  return inner;
}

double MotionLimits::Used(const Motion& motion, const MatrixXd& torque) const {
  double used = 0;
  for (int j = 0; j < motion.num_joints(); ++j) {
    used =
        std::max({used, LargestShare(PositionBand(*this, j), motion.q.col(j)),
                  LargestShare({0, velocity[j]}, motion.qd.col(j)),
                  LargestShare({0, acceleration[j]}, motion.qdd.col(j)),
                  LargestShare({0, effort[j]}, torque.col(j))});
  }
  return used;
}

// The file's limits, or cautious ones where it has none: a design without any
// would run off to infinite speed, as information grows with it. Each
// assumption is told, since a real arm's range may be smaller.
MotionLimits LimitsOf(const Robot& robot, std::vector<std::string>* assumed) {
  const int n = robot.num_joints();
  MotionLimits limits{VectorXd(n), VectorXd(n), VectorXd(n), VectorXd(n),
                      VectorXd(n)};
  std::string without_range, without_speed, without_effort;
  for (int j = 0; j < n; ++j) {
    const Joint& joint = robot.links[j].joint;
    const bool turns = IsRotational(joint.type);
    const double reach = turns ? 1.5 : .2;
    const bool ranged =
        std::isfinite(joint.lower) && std::isfinite(joint.upper);
    limits.lower[j] = ranged ? joint.lower : -reach;
    limits.upper[j] = ranged ? joint.upper : reach;
    const bool rated = std::isfinite(joint.velocity);
    limits.velocity[j] = rated ? joint.velocity : turns ? 1 : .25;
    limits.acceleration[j] = 3 * limits.velocity[j];
    limits.effort[j] = joint.effort;
    if (!ranged) without_range += " " + joint.name;
    if (!rated) without_speed += " " + joint.name;
    if (!std::isfinite(joint.effort)) without_effort += " " + joint.name;
  }
  const auto say = [assumed](const std::string& joints,
                             const std::string& what) {
    if (!joints.empty()) assumed->push_back(what + ":" + joints);
  };
  say(without_range, "positions within 1.5 rad or 0.2 m of zero");
  say(without_speed, "velocities up to 1 rad/s or 0.25 m/s");
  say(without_effort, "any torque");
  assumed->push_back(
      "accelerations up to three times the velocity in a second");
  return limits;
}

double LimitBarrier(const MotionLimits& limits, const Motion& motion,
                    const MatrixXd& torque, double factor,
                    MotionGradient* gradient, MatrixXd* of_torque) {
  const double each = factor / static_cast<double>(motion.size());
  double sum = 0;
  for (int j = 0; j < motion.num_joints(); ++j) {
    sum += AddBand(PositionBand(limits, j), motion.q.col(j), each,
                   gradient->q.col(j));
    sum += AddBand({0, limits.velocity[j]}, motion.qd.col(j), each,
                   gradient->qd.col(j));
    sum += AddBand({0, limits.acceleration[j]}, motion.qdd.col(j), each,
                   gradient->qdd.col(j));
    sum +=
        AddBand({0, limits.effort[j]}, torque.col(j), each, of_torque->col(j));
  }
  return sum / static_cast<double>(motion.size());
}

}  // namespace armcal
