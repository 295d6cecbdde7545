#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/refine/arm_trust.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/arm_geometry.h"
#include "model/robot/robot.h"
#include "problems/poses/pose_problem.h"

namespace armcal {

// Values of all that a calibration of torques and poses can find.
struct ArmValues {
  Eigen::VectorXd links;  // 10 per link, ToVector()'s order
  Eigen::VectorXd terms;  // 4 per joint: viscous, coulomb, offset, armature
  Eigen::Vector2d tilt;   // rad; pitch and roll of the base against gravity
  PoseUnknowns poses;     // geometry (its base: in the instrument), targets

  Eigen::VectorXd Stacked() const;
  void SetStacked(const Eigen::VectorXd& stacked);
};

// What is unknown of an arm, in the order of ArmValues::Stacked(): names,
// units, what the robot file says, how far it is trusted, and what is held.
class ArmUnknowns {
 public:
  // `poses` may be null. Joint terms that `linear` has not are held.
  ArmUnknowns(const Robot& robot, const LinearCalibration& linear,
              RefineGeometry refine, const PoseMeasurements* poses);

  int size() const { return static_cast<int>(names_.size()); }
  int num_links() const { return robot_.num_joints(); }
  int terms_begin() const { return 10 * num_links(); }
  int tilt_begin() const { return 14 * num_links(); }
  int geometry_begin() const { return tilt_begin() + 2; }
  int other_begin() const { return geometry_begin() + geometry_.size(); }
  const std::string& name(int k) const { return names_[k]; }
  const std::string& unit(int k) const { return units_[k]; }
  bool is_free(int k) const { return free_[k]; }
  // The links that are estimated, which are bodies: those that the file says
  // have no mass (IsDeclaredMassless) are held at 0.
  const std::vector<int>& bodies() const { return bodies_; }
  // Friction and armature that are estimated.
  bool is_positive(int k) const;
  std::vector<int> FreeIndices() const;
  bool refines_geometry() const { return !torque_geometry_.empty(); }
  bool has_poses() const { return has_poses_; }

  const Robot& robot() const { return robot_; }  // the file's
  const ArmValues& nominal() const { return nominal_; }
  const std::vector<JointTermColumn>& terms() const { return terms_; }
  // Standard deviation of the normal prior on parameter k, about the file's
  // value; 0: none. (Links have InertialPrior.)
  double NormalPrior(int k, const ArmTrust& trust) const;
  // Parameters of ArmGeometry(robot) that torques are taken linearly in, and
  // where their columns belong.
  const std::vector<int>& torque_geometry() const { return torque_geometry_; }
  std::vector<int> TorqueColumns() const;

  // The geometry with these values, its base tilted against gravity.
  ArmGeometry Geometry(const ArmValues& values) const;
  // The file's robot with these inertias and joint terms, but its own geometry.
  Robot WithInertia(const ArmValues& values) const;
  // The robot with these values; its gravity turned by the tilt.
  Robot Apply(const ArmValues& values) const;

 private:
  void AddTerms(const LinearCalibration& linear);
  void AddGeometry(RefineGeometry refine, const PoseMeasurements* poses);
  void Add(const std::string& name, const std::string& unit, bool is_free);

  Robot robot_;
  ArmGeometry geometry_;
  std::vector<JointTermColumn> terms_;
  std::vector<int> torque_geometry_;
  bool has_poses_;
  ArmValues nominal_;
  std::vector<std::string> names_, units_;
  std::vector<bool> free_;
  std::vector<int> bodies_;
  Eigen::VectorXd torque_rms_;    // per joint
  Eigen::VectorXd other_priors_;  // standard deviations, 0: none
};

}  // namespace armcal
