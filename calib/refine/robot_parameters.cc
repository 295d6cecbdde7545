#include "calib/refine/robot_parameters.h"

#include "model/dynamics/joint_term.h"

namespace armcal {
namespace {

constexpr JointTerm kCalibratedTerms[] = {
    JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset,
    JointTerm::kArmature};

std::string NameOf(const Link& link, int inertial) {
  return link.name + "." + InertialName(inertial);
}

std::string NameOf(const Joint& joint, JointTerm term) {
  return joint.name + "." + JointTermName(term);
}

}  // namespace

// A robot stands in its world only by its tilt against gravity: x, y, z and yaw
// of the base are the instrument's.
RobotParameters::RobotParameters(const Robot& nominal)
    : nominal_(nominal), geometry_(nominal) {
  const auto add = [this](const std::string& name, const std::string& unit,
                          double value, bool geometric) {
    parameters_[name] = {unit, value, value, geometric};
  };
  for (const Link& link : nominal.links) {
    const Vector10d V = link.inertial.ToVector();
    for (int k = 0; k < 10; ++k) {
      add(NameOf(link, k), InertialUnit(k), V[k], false);
    }
    for (const JointTerm term : kCalibratedTerms) {
      add(NameOf(link.joint, term), JointTermUnit(term, link.joint.type),
          TermOf(term, link.joint), false);
    }
  }
  const std::vector<std::string> names = geometry_.Names();
  const std::vector<std::string> units = geometry_.Units();
  const Eigen::VectorXd values = geometry_.Values();
  for (int k = 0; k < geometry_.size(); ++k) {
    const bool tilt = names[k] == "base.pitch" || names[k] == "base.roll";
    if (ArmGeometry::IsBase(k) && !tilt) continue;
    add(names[k], units[k], values[k], true);
  }
}

// The geometry is left alone unless a value of it has changed: applying it
// writes frames anew, with rounding that would make an equal robot differ.
Robot RobotParameters::Apply() const {
  Robot robot = nominal_;
  for (Link& link : robot.links) {
    Vector10d V;
    for (int k = 0; k < 10; ++k) V[k] = Value(NameOf(link, k));
    link.inertial = InertialParameters::FromVector(V);
    link.has_inertial = !IsDeclaredMassless(link);
    for (const JointTerm term : kCalibratedTerms) {
      *TermOf(term, &link.joint) = Value(NameOf(link.joint, term));
    }
  }
  const Eigen::VectorXd file = geometry_.Values();
  Eigen::VectorXd values = file;
  const std::vector<std::string> names = geometry_.Names();
  for (int k = 0; k < geometry_.size(); ++k) {
    if (Has(names[k])) values[k] = Value(names[k]);
  }
  if (values == file) return robot;
  ArmGeometry geometry = geometry_;
  geometry.SetValues(values);
  return geometry.ApplyTo(robot);
}

bool IsNeverNegative(const std::string& name) {
  const std::string term = name.substr(name.rfind('.') + 1);
  return term == "mass" || term == "viscous" || term == "coulomb" ||
         term == "armature";
}

}  // namespace armcal
