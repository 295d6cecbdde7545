#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/poses/diagnosis/model.h"
#include "calib/poses/effects/effect.h"
#include "model/robot/robot.h"

namespace armcal {

// An arm as measured poses show it: links of a refined geometry, and what
// depends on the posture beside them (couplings, eccentric encoders, sag).
// A robot file holds the links alone.
class ActualArm {
 public:
  // A displacement by `amount` times a signal of the posture.
  struct Term {
    PoseTerm::Acts acts;  // kJoint, kBase or kTool
    int index;
    PostureSignal signal;
    double amount;
  };

  // By a model that poses were explained with. Base frame and tool are those of
  // its robot: a base is wherever its controller says. Joints' zeros that moved
  // are as they were in the end.
  explicit ActualArm(const PoseModel& model);

  int num_joints() const { return file().num_joints(); }
  const Robot& file() const { return known_.robot; }
  const KnownArm& known() const { return known_; }
  // Rad, added to where joints stand for what their displacements depend on, by
  // the file's geometry.
  const Eigen::VectorXd& zeros() const { return zeros_; }
  // The file with the refined links.
  const Robot& links() const { return links_; }
  const std::vector<Term>& terms() const { return terms_; }
  // Effects of the model that are none of the arm's: of the instrument, of
  // targets that slipped. For people.
  const std::vector<std::string>& left_out() const { return left_out_; }

  // Where joints stand that were recorded at q (rad or m).
  Eigen::VectorXd Standing(const Eigen::VectorXd& q) const;
  // X_WT at recorded joint positions q.
  Eigen::Isometry3d ToolPose(const Eigen::VectorXd& q) const;

 private:
  void Add(const PoseModel& model, size_t effect);
  // What all terms move at joints that stand at `standing`.
  struct Moved {
    Eigen::VectorXd joints;      // rad or m
    Eigen::Vector3d base;        // rotation vector, rad
    Eigen::Vector3d tool, turn;  // of the tool, m and rad
  };
  Moved At(const Eigen::VectorXd& q, const Eigen::VectorXd& standing) const;
  // What they move where joints were recorded at q: signals are of where joints
  // stand, which signals displace; what is left after two rounds is of third
  // order.
  Moved Settled(const Eigen::VectorXd& q) const;

  KnownArm known_;
  Eigen::VectorXd zeros_;  // PoseCampaign
  Robot links_;
  std::vector<Term> terms_;
  std::vector<std::string> left_out_;
};

}  // namespace armcal
