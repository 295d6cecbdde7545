#include "calib/refine/arm_unknowns.h"

#include <algorithm>

#include "calib/poses/fit.h"
#include "problems/link_functions.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// The base of ArmGeometry has the parameters x y z yaw pitch roll.
constexpr int kBaseSize = 6;
constexpr int kBasePitch = 4, kBaseRoll = 5;

constexpr JointTerm kUnknownTerms[] = {JointTerm::kViscous, JointTerm::kCoulomb,
                                       JointTerm::kOffset,
                                       JointTerm::kArmature};

}  // namespace

VectorXd ArmValues::Stacked() const {
  VectorXd all(links.size() + terms.size() + 2 + poses.geometry.size() +
               poses.other.size());
  all << links, terms, tilt, poses.geometry, poses.other;
  return all;
}

void ArmValues::SetStacked(const VectorXd& stacked) {
  Eigen::Index at = 0;
  const auto next = [&](Eigen::Index size) {
    at += size;
    return stacked.segment(at - size, size);
  };
  links = next(links.size()).eval();
  terms = next(terms.size()).eval();
  tilt = next(2).eval();
  poses.geometry = next(poses.geometry.size()).eval();
  poses.other = next(poses.other.size()).eval();
}

// A joint's torque says what is large for its terms' priors; a joint without
// any has a thousandth of the largest, so that its prior is not infinitely
// sharp.
ArmUnknowns::ArmUnknowns(const Robot& robot, const LinearCalibration& linear,
                         RefineGeometry refine, const PoseMeasurements* poses)
    : robot_(robot), geometry_(robot), has_poses_(poses != nullptr) {
  nominal_.links = StackInertials(robot);
  for (int i = 0; i < robot.num_joints(); ++i) {
    const bool is_body = !IsDeclaredMassless(robot.links[i]);
    if (is_body) bodies_.push_back(i);
    for (int k = 0; k < 10; ++k) {
      Add(robot.links[i].name + "." + InertialName(k), InertialUnit(k),
          is_body);
    }
  }
  AddTerms(linear);
  torque_rms_.setOnes(robot.num_joints());
  if (linear.training) {
    const Eigen::VectorXd rms = linear.training->moving().torque_rms;
    torque_rms_ = rms.cwiseMax(1e-3 * rms.maxCoeff() + 1e-9);
  }
  AddGeometry(refine, poses);
}

void ArmUnknowns::Add(const std::string& name, const std::string& unit,
                      bool is_free) {
  names_.push_back(name);
  units_.push_back(unit);
  free_.push_back(is_free);
}

// All joints have all four terms, so that places do not depend on what was
// asked for; those that the linear calibration has not are held at the file's
// values.
void ArmUnknowns::AddTerms(const LinearCalibration& linear) {
  const int n = robot_.num_joints();
  nominal_.terms.resize(4 * n);
  for (int j = 0; j < n; ++j) {
    Joint& joint = robot_.links[j].joint;
    for (const JointTerm term : kUnknownTerms) {
      JointTermColumn column{j, term, {}};
      if (!linear.transitions.empty()) {
        column.transition = linear.transitions[j];
      }
      nominal_.terms[static_cast<int>(terms_.size())] = *TermOf(term, &joint);
      terms_.push_back(column);
      Add(joint.name + "." + JointTermName(term),
          JointTermUnit(term, joint.type),
          std::count(linear.joint_terms.begin(), linear.joint_terms.end(),
                     term) > 0);
    }
  }
}

// Adds the geometry, which torques and poses share, but for the base: poses
// have it in the instrument's frame, torques against gravity. Torques see of
// the base only its tilt, pitch and roll, as a turn about the vertical or a
// shift changes none of them.
void ArmUnknowns::AddGeometry(RefineGeometry refine,
                              const PoseMeasurements* poses) {
  const bool tilts = refine == RefineGeometry::kAll;
  nominal_.tilt.setZero();
  Add("base.pitch", "rad", tilts);
  Add("base.roll", "rad", tilts);
  if (tilts) torque_geometry_ = {kBasePitch, kBaseRoll};
  nominal_.poses.geometry = geometry_.Values();
  const std::vector<std::string> names = geometry_.Names();
  const std::vector<bool> free = FreeGeometry(geometry_, refine, poses);
  for (int k = 0; k < geometry_.size(); ++k) {
    std::string name = names[k];
    const bool own = !ArmGeometry::IsBase(k) && !geometry_.IsTool(k);
    if (ArmGeometry::IsBase(k)) name.replace(0, 4, "instrument");  // "base.x"
    if (own && free[k]) torque_geometry_.push_back(k);
    Add(name, geometry_.Units()[k], free[k]);
  }
  if (poses == nullptr) return;
  nominal_.poses.other = VectorXd::Zero(PoseUnknowns::NumOther(*poses));
  // A plane is z + a x + b y = c (plane_residual.h): a and b are plain numbers.
  for (const std::string& name : PoseUnknowns::OtherNames(*poses)) {
    const bool plain =
        poses->planes ? name.back() != 'c' : poses->poses.size() > 0;
    Add(name, plain ? "1" : "m", true);
  }
  other_priors_ = PoseUnknowns::OtherPriors(*poses);
}

std::vector<int> ArmUnknowns::FreeIndices() const {
  std::vector<int> indices;
  for (int k = 0; k < size(); ++k) {
    if (free_[k]) indices.push_back(k);
  }
  return indices;
}

bool ArmUnknowns::is_positive(int k) const {
  return k >= terms_begin() && k < tilt_begin() && free_[k] &&
         terms_[k - terms_begin()].term != JointTerm::kOffset;
}

// The prior's standard deviation, in the order of Stacked(). That of joint
// terms is a multiple of the joint's torque per unit of speed or acceleration:
// wide enough to say nothing where the motion tells, narrow enough to keep the
// rest finite.
double ArmUnknowns::NormalPrior(int k, const ArmTrust& trust) const {
  if (k < terms_begin()) return 0;
  if (k < tilt_begin()) {
    return trust.joint_terms * torque_rms_[terms_[k - terms_begin()].joint];
  }
  if (k < geometry_begin()) return trust.angle;
  if (k >= other_begin()) return other_priors_[k - other_begin()];
  return GeometryPrior(geometry_, k - geometry_begin(), trust.length,
                       trust.angle);
}

// Where a column of LinkFunctions belongs among all unknowns: the base's pitch
// and roll are the tilt and not the instrument's.
std::vector<int> ArmUnknowns::TorqueColumns() const {
  std::vector<int> columns;
  for (int k = 0; k < tilt_begin(); ++k) columns.push_back(k);
  for (const int k : torque_geometry_) {
    columns.push_back(k == kBasePitch  ? tilt_begin()
                      : k == kBaseRoll ? tilt_begin() + 1
                                       : geometry_begin() + k);
  }
  return columns;
}

ArmGeometry ArmUnknowns::Geometry(const ArmValues& values) const {
  VectorXd g = values.poses.geometry;
  g.head(kBaseSize).setZero();
  g[kBasePitch] = values.tilt[0];
  g[kBaseRoll] = values.tilt[1];
  ArmGeometry geometry = geometry_;
  geometry.SetValues(g);
  return geometry;
}

Robot ArmUnknowns::WithInertia(const ArmValues& values) const {
  Robot robot = robot_;
  for (int i = 0; i < num_links(); ++i) {
    robot.links[i].inertial =
        InertialParameters::FromVector(values.links.segment<10>(10 * i));
    robot.links[i].has_inertial = !IsDeclaredMassless(robot.links[i]);
  }
  for (size_t t = 0; t < terms_.size(); ++t) {
    *TermOf(terms_[t].term, &robot.links[terms_[t].joint].joint) =
        values.terms[static_cast<int>(t)];
  }
  return robot;
}

Robot ArmUnknowns::Apply(const ArmValues& values) const {
  const Robot robot = WithInertia(values);
  return refines_geometry() || has_poses_ ? Geometry(values).ApplyTo(robot)
                                          : robot;
}

}  // namespace armcal
