#include "problems/workspace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>

#include "model/robot/kinematics.h"
#include "model/text/uniform_draw.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kReach = .05;  // m, of the barrier
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string Text(const Box& box) {
  std::string text;
  for (int k = 0; k < 3; ++k) {
    char range[64];
    std::snprintf(range, sizeof range, "%s%g:%g", k ? "," : "", box.low[k],
                  box.high[k]);
    text += range;
  }
  return text;
}

}  // namespace

// The signed distance to a thing and its gradient. The floor's is along `up`.
// In a box it is that to the nearest wall, with a minus where the box is an
// obstacle; outside of an obstacle it is that to its nearest point.
Workspace::Distance Workspace::Thing::DistanceOf(const Vector3d& p_W) const {
  if (kind == Kind::kFloor) return {up.dot(p_W) - height, up};
  // The nearest wall's, from inside.
  Distance inside{kInfinity, Vector3d::Zero()};
  for (int k = 0; k < 3; ++k) {
    for (const double side : {-1., 1.}) {
      const double depth =
          side < 0 ? p_W[k] - box.low[k] : box.high[k] - p_W[k];
      if (depth >= inside.value) continue;
      inside = {depth, -side * Vector3d::Unit(k)};
    }
  }
  if (kind == Kind::kInside) return inside;
  if (inside.value >= 0) return {-inside.value, -inside.gradient};
  const Vector3d away = p_W - p_W.cwiseMax(box.low).cwiseMin(box.high);
  return {away.norm(), away.normalized()};
}

Workspace::Workspace(const Robot& robot, const WorkspaceOptions& options,
                     const VectorXd& lower, const VectorXd& upper)
    : robot_(robot) {
  AddBalls(options.link_radius);
  AddThings(options);
  AddPairs(lower, upper);
}

// Balls along each link from its joint to the next joints and to the tool, at
// most a diameter apart. Distances from balls are closed forms with gradients;
// meshes would need a library and tell a design of motion little more. The last
// ball, of radius 0, is the tool's point.
void Workspace::AddBalls(double radius) {
  const int n = robot_.num_joints();
  for (int i = 0; i < n; ++i) {
    const Link& link = robot_.links[i];
    const Vector3d from = link.X_ML.inverse().translation();
    std::vector<Vector3d> ends;
    for (int k = i + 1; k < n; ++k) {
      if (robot_.parent(k) != i) continue;
      ends.emplace_back(robot_.links[k].X_PF.translation());
    }
    if (i + 1 == n) ends.emplace_back(robot_.X_LT.translation());
    if (ends.empty()) ends.push_back(Vector3d::Zero());
    for (const Vector3d& to : ends) {
      const int steps = std::max(
          1, static_cast<int>(std::ceil((to - from).norm() / (2 * radius))));
      for (int k = 0; k <= steps; ++k) {
        balls_.push_back({i, from + k * (to - from) / steps, radius});
      }
    }
  }
  balls_.push_back({n - 1, robot_.X_LT.translation(), 0});
}

void Workspace::AddThings(const WorkspaceOptions& options) {
  using Kind = Thing::Kind;
  if (options.floor) {
    Thing floor{Kind::kFloor, {}, *options.floor, {0, 0, 1}, "the floor"};
    if (robot_.gravity.norm() > 0) floor.up = -robot_.gravity.normalized();
    things_.push_back(floor);
  }
  for (const Box& box : options.obstacles) {
    things_.push_back(
        {Kind::kBox, box, 0, {0, 0, 1}, "the obstacle " + Text(box)});
  }
  if (options.tool_box) {
    things_.push_back({Kind::kInside,
                       *options.tool_box,
                       0,
                       {0, 0, 1},
                       "the tool's box " + Text(*options.tool_box)});
  }
}

// Finds which balls are held against which things: 400 random postures within
// the limits, always the same ones, give the least and the largest distance of
// each pair. One that does not move cannot be kept clear by a motion; one that
// is never clear is an error of the input.
void Workspace::AddPairs(const VectorXd& lower, const VectorXd& upper) {
  constexpr int kPostures = 400;
  constexpr double kStill = 1e-3;  // m
  std::mt19937_64 random(1);
  const int balls = static_cast<int>(balls_.size());
  const int things = static_cast<int>(things_.size());
  MatrixXd least = MatrixXd::Constant(balls, things, kInfinity), most = -least;
  for (int s = 0; s < kPostures; ++s) {
    VectorXd q(lower.size());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const double share = UniformDraw(&random);
      q[j] = lower[j] + share * (upper[j] - lower[j]);
    }
    const std::vector<Vector3d> centers = Centers(LinkPoses(robot_, q));
    for (int b = 0; b < balls; ++b) {
      for (int k = 0; k < things; ++k) {
        const double clear =
            things_[k].DistanceOf(centers[b]).value - balls_[b].radius;
        least(b, k) = std::min(least(b, k), clear);
        most(b, k) = std::max(most(b, k), clear);
      }
    }
  }
  for (int b = 0; b < balls; ++b) {
    for (int k = 0; k < things; ++k) {
      const bool inside = things_[k].kind == Thing::Kind::kInside;
      if (inside != (b + 1 == balls)) continue;
      if (most(b, k) - least(b, k) < kStill) continue;
      if (most(b, k) < 0) {
        throw std::invalid_argument(
            "no posture keeps " + robot_.links[balls_[b].link].name +
            (inside ? " in " : " clear of ") + things_[k].text);
      }
      pairs_.push_back({b, k});
    }
  }
}

std::vector<Vector3d> Workspace::Centers(
    const std::vector<Isometry3d>& X_WL) const {
  std::vector<Vector3d> centers;
  for (const Ball& ball : balls_) {
    centers.emplace_back(X_WL[ball.link] * ball.center_L);
  }
  return centers;
}

double Workspace::Clearance(const MatrixXd& q) const {
  double least = kInfinity;
  if (empty()) return least;
  for (Eigen::Index s = 0; s < q.rows(); ++s) {
    const auto centers = Centers(LinkPoses(robot_, q.row(s)));
    for (const Pair& pair : pairs_) {
      const Distance distance =
          things_[pair.thing].DistanceOf(centers[pair.ball]);
      least = std::min(least, distance.value - balls_[pair.ball].radius);
    }
  }
  return least;
}

// b(d) = -log(1 - exp(-d / reach)) of each pair's room d: like -log(d / reach)
// near 0 and like exp(-d / reach) far away, where a plain logarithm would go on
// pushing across the whole room. db/dd = -1 / (reach (exp(d / reach) - 1));
// expm1 keeps both exact near 0. The gradient in joints is the centre's force
// times its velocity per joint's: z x (p - o) of a turning joint, z of a
// sliding one.
double Workspace::Barrier(const MatrixXd& q, double margin, double factor,
                          MotionGradient* gradient) const {
  if (empty()) return 0;
  const double each = factor / static_cast<double>(q.rows());
  double sum = 0;
  for (Eigen::Index s = 0; s < q.rows(); ++s) {
    const std::vector<Isometry3d> X_WL = LinkPoses(robot_, q.row(s));
    const std::vector<Vector3d> centers = Centers(X_WL);
    std::vector<Vector3d> of_center(balls_.size(), Vector3d::Zero());
    for (const Pair& pair : pairs_) {
      const Distance distance =
          things_[pair.thing].DistanceOf(centers[pair.ball]);
      const double room = distance.value - balls_[pair.ball].radius - margin;
      if (!(room > 0)) return kInfinity;
      sum -= std::log(-std::expm1(-room / kReach));
      of_center[pair.ball] -=
          distance.gradient / (kReach * std::expm1(room / kReach));
    }
    for (size_t b = 0; b < balls_.size(); ++b) {
      if (of_center[b].isZero(0)) continue;
      for (int j = balls_[b].link; j >= 0; j = robot_.parent(j)) {
        const Joint& joint = robot_.links[j].joint;
        const Isometry3d X_WM = X_WL[j] * robot_.links[j].X_ML.inverse();
        const Vector3d z = X_WM.linear().col(2);
        const Vector3d moves = IsRotational(joint.type)
                                   ? z.cross(centers[b] - X_WM.translation())
                                   : z;
        gradient->q(s, j) += each * of_center[b].dot(moves);
      }
    }
  }
  return sum / static_cast<double>(q.rows());
}

}  // namespace armcal
