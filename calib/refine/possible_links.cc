#include "calib/refine/possible_links.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "calib/refine/link_start.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/text/uniform_draw.h"
#include "problems/inertial_coordinates.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kStates = 200;
// What of a joint's rms torque counts as a difference: where links only share
// out what logs show, and, over all states together, where no links could have
// all of it.
constexpr double kDifference = 1e-2;
constexpr double kLooseDifference = .1;
constexpr double kFarPercent = 5;
constexpr double kTrust = .5;

struct State {
  VectorXd q, qd, qdd;
};

double Draw(double low, double high, std::mt19937_64* random) {
  return low + (high - low) * UniformDraw(random);
}

// A state of motion as the log has it: positions are uniform over their range,
// velocities and accelerations have the log's rms.
State DrawState(const MotionScale& scale, std::mt19937_64* random) {
  const Eigen::Index n = scale.low.size();
  const double usual = std::sqrt(3.);  // of a uniform draw of rms 1
  State state{VectorXd(n), VectorXd(n), VectorXd(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    state.q[j] = Draw(scale.low[j], scale.high[j], random);
    state.qd[j] = usual * scale.speed[j] * Draw(-1, 1, random);
    state.qdd[j] = usual * scale.acceleration[j] * Draw(-1, 1, random);
  }
  return state;
}

// The torque is linear in the inertial parameters of links[k] and in the
// joints' armature (Atkeson, An & Hollerbach 1986, Int. J. Robotics Research
// 5). Columns are in that order, with a row per state and joint, and come from
// inverse dynamics of one unit parameter at a time.
MatrixXd TorqueColumns(Robot robot, const std::vector<int>& links,
                       const MotionScale& scale) {
  const int n = robot.num_joints(), m = 10 * static_cast<int>(links.size());
  MatrixXd columns = MatrixXd::Zero(kStates * n, m + n);
  std::mt19937_64 random(1);
  for (Link& link : robot.links) link.inertial = InertialParameters();
  for (int s = 0; s < kStates; ++s) {
    const State state = DrawState(scale, &random);
    for (int k = 0; k < m; ++k) {
      InertialParameters& body = robot.links[links[k / 10]].inertial;
      body = InertialParameters::FromVector(Vector10d::Unit(k % 10));
      columns.block(s * n, k, n, 1) =
          InverseDynamics(robot, state.q, state.qd, state.qdd);
      body = InertialParameters();
    }
    columns.block(s * n, m, n, n) = state.qdd.asDiagonal();
  }
  return columns;
}

double Rms(const VectorXd& torque, int joint, int n) {
  const Eigen::Map<const VectorXd, 0, Eigen::InnerStride<>> of_joint(
      torque.data() + joint, torque.size() / n, Eigen::InnerStride<>(n));
  return std::sqrt(of_joint.squaredNorm() / of_joint.size());
}

// Bodies inside what can exist, then the joints' armature. A fitted link that
// cannot exist begins as the file's.
VectorXd StartValues(const Robot& robot, const Robot& file,
                     const std::vector<int>& links) {
  const int m = 10 * static_cast<int>(links.size());
  VectorXd x(m + robot.num_joints());
  for (size_t k = 0; k < links.size(); ++k) {
    const InertialParameters& fitted = robot.links[links[k]].inertial;
    const bool possible = WhyUnphysical(fitted).empty();
    const Vector10d c = LogCholeskyFromInertial(
        (possible ? fitted : file.links[links[k]].inertial).ToVector(), .01,
        .01);
    InertialFromLogCholesky(c.data(), x.data() + 10 * k);
  }
  for (int j = 0; j < robot.num_joints(); ++j) {
    x[m + j] = robot.links[j].joint.armature;
  }
  return x;
}

std::vector<int> LinksWithInertia(const Robot& robot) {
  std::vector<int> links;
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (!robot.links[i].inertial.ToVector().isZero(0)) links.push_back(i);
  }
  return links;
}

// The columns in units of what a joint's torque may differ by.
MatrixXd Weighted(MatrixXd columns, const VectorXd& usual_torque,
                  double difference) {
  const Eigen::Index n = usual_torque.size();
  for (Eigen::Index r = 0; r < columns.rows(); ++r) {
    columns.row(r) /= difference * std::max(1e-9, usual_torque[r % n]);
  }
  return columns;
}

Robot WithValues(Robot robot, const std::vector<int>& links,
                 const VectorXd& x) {
  for (size_t k = 0; k < links.size(); ++k) {
    robot.links[links[k]].inertial =
        InertialParameters::FromVector(x.segment<10>(10 * k));
  }
  for (int j = 0; j < robot.num_joints(); ++j) {
    robot.links[j].joint.armature = x[10 * links.size() + j];
  }
  return robot;
}

}  // namespace

// Solves |columns (x - fitted)|^2 in these units plus the divergence of the
// links from where they start (StartLinks): torques are kept, and what torques
// do not show moves as little as it takes to be a body. Traversaro et al.
// (2016, IROS) and Wensing, Kim & Slotine (2018) have the conditions for one.
// If no links come within kFarPercent of a joint's torque, the torques count
// for less.
std::optional<PossibleLinks> FindPossibleLinks(
    const Robot& robot, const Robot& file, const MotionScale& scale,
    const std::vector<bool>& free_armature) {
  const int n = robot.num_joints();
  const std::vector<int> links = LinksWithInertia(robot);
  const int m = 10 * static_cast<int>(links.size());
  const MatrixXd columns = TorqueColumns(robot, links, scale);
  const VectorXd start = StartValues(robot, file, links);
  VectorXd fitted = start;
  for (size_t k = 0; k < links.size(); ++k) {
    fitted.segment<10>(10 * k) = robot.links[links[k]].inertial.ToVector();
  }
  std::vector<TermRange> ranges;
  for (int j = 0; j < n; ++j) {
    const bool free = free_armature[j] && start[m + j] > 0;
    ranges.push_back(free ? TermRange::kPositive : TermRange::kHeld);
  }
  std::optional<PossibleLinks> possible;
  for (const double difference :
       {kDifference, kLooseDifference * std::sqrt(double(kStates))}) {
    const MatrixXd R = Weighted(columns, scale.torque, difference);
    const auto found = StartLinks(R, R * fitted, kTrust, ranges, start);
    if (!found) return std::nullopt;
    possible = {WithValues(robot, links, *found), VectorXd(n)};
    const VectorXd differs = columns * (*found - fitted);
    for (int j = 0; j < n; ++j) {
      possible->differs_percent[j] =
          100 * Rms(differs, j, n) / std::max(1e-9, scale.torque[j]);
    }
    if (possible->differs_percent.maxCoeff() < kFarPercent) break;
  }
  return possible;
}

}  // namespace armcal
