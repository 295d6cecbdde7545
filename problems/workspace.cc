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

// The last ball is the tool's point.
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
