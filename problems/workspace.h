#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/robot/robot.h"
#include "problems/motion_information.h"
#include "problems/workspace_options.h"

namespace armcal {

// The room of an arm whose links are rows of balls from joint to joint and on
// to the tool: what it is kept clear of, and how clear it is.
class Workspace {
 public:
  // None: nothing is in the way.
  Workspace() = default;
  // Balls whose distance from something does not depend on the posture (the
  // base stands on the floor) are not held against it. `lower`, `upper`: of the
  // joints, rad or m. Throws std::invalid_argument with a sentence where no
  // posture is clear.
  Workspace(const Robot& robot, const WorkspaceOptions& options,
            const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

  bool empty() const { return pairs_.empty(); }
  // Least distance over all samples, m; negative where something touches.
  double Clearance(const Eigen::MatrixXd& q) const;
  // The mean over samples of sum -log(1 - exp(-(distance - margin) / reach)):
  // next to nothing far away, infinite at `margin` m and nearer. Adds `factor`
  // times its gradient in positions.
  double Barrier(const Eigen::MatrixXd& q, double margin, double factor,
                 MotionGradient* gradient) const;

 private:
  struct Ball {
    int link;
    Eigen::Vector3d center_L;
    double radius;
  };
  // A ball and something that it is held against.
  struct Pair {
    int ball, thing;
  };
  struct Distance {
    double value;              // m, between surfaces
    Eigen::Vector3d gradient;  // in the ball's centre
  };
  struct Thing {
    enum class Kind { kFloor, kBox, kInside } kind;
    Box box;
    double height = 0;
    Eigen::Vector3d up{0, 0, 1};
    std::string text;

    Distance DistanceOf(const Eigen::Vector3d& p_W) const;
  };

  void AddBalls(double radius);
  void AddThings(const WorkspaceOptions& options);
  void AddPairs(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  std::vector<Eigen::Vector3d> Centers(
      const std::vector<Eigen::Isometry3d>& X_WL) const;

  Robot robot_;
  std::vector<Ball> balls_;
  std::vector<Thing> things_;
  std::vector<Pair> pairs_;
};

}  // namespace armcal
