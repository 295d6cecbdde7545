#include "calib/loop_unknowns.h"

#include <glog/logging.h>

#include <algorithm>

#include "model/drive_law.h"
#include "problems/link_functions.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr JointTerm kTerms[] = {JointTerm::kViscous, JointTerm::kCoulomb,
                                JointTerm::kOffset, JointTerm::kArmature};
constexpr double kAny = -1;

// Of a drive's gain, as its files name it.
std::string GainUnit(JointType type, const std::string& gain) {
  for (const DriveParameter& parameter : DriveParameters()) {
    if (parameter.name != gain) continue;
    return IsRotational(type) ? parameter.unit : parameter.linear_unit;
  }
  LOG(FATAL) << "no gain " << gain;
}

}  // namespace

LoopUnknowns::LoopUnknowns(const LoopValues& nominal, const LoopTrust& trust,
                           const std::vector<JointTerm>& joint_terms,
                           const VectorXd& torque_rms)
    : n_(nominal.arm.robot.num_joints()), files_(nominal) {
  const Robot& robot = nominal.arm.robot;
  for (const Link& link : robot.links) {
    for (int k = 0; k < 10; ++k) {
      Add(link.name + "." + InertialName(k), InertialUnit(k), trust.inertia,
          kAny);
    }
  }
  for (int j = 0; j < n_; ++j) {
    const Joint& joint = robot.links[j].joint;
    for (const JointTerm term : kTerms) {
      const bool wanted =
          std::count(joint_terms.begin(), joint_terms.end(), term) > 0;
      Add(joint.name + "." + JointTermName(term),
          JointTermUnit(term, joint.type),
          wanted ? trust.joint_terms * torque_rms[j] : 0,
          term == JointTerm::kOffset ? kAny : 0);
    }
  }
  const bool has_coulomb = std::count(joint_terms.begin(), joint_terms.end(),
                                      JointTerm::kCoulomb) > 0;
  for (int j = 0; j < n_; ++j) {
    const Joint& joint = robot.links[j].joint;
    const double width = nominal.arm.transitions[j].width;
    Add(joint.name + ".coulomb_width",
        std::string(PositionUnit(joint.type)) + "/s",
        has_coulomb ? trust.width * width : 0, .1 * width);
  }
  for (const auto& [gain, value] :
       {std::make_pair("kp", &nominal.kp), std::make_pair("kd", &nominal.kd),
        std::make_pair("ki", &nominal.ki)}) {
    for (int j = 0; j < n_; ++j) {
      const Joint& joint = robot.links[j].joint;
      Add(joint.name + "." + gain, GainUnit(joint.type, gain),
          trust.gains * (*value)[j], 0);
    }
  }
  Add("drive.delay", "s", trust.delay, kAny);
  nominal_ = Stack(nominal);
}

void LoopUnknowns::Add(const std::string& name, const std::string& unit,
                       double prior, double least) {
  names_.push_back(name);
  units_.push_back(unit);
  prior_.push_back(prior);
  least_.push_back(least);
  free_.push_back(prior > 0);
}

std::vector<int> LoopUnknowns::FreeIndices() const {
  std::vector<int> indices;
  for (int k = 0; k < size(); ++k) {
    if (free_[k]) indices.push_back(k);
  }
  return indices;
}

VectorXd LoopUnknowns::Stack(const LoopValues& values) const {
  const LoopColumns columns(n_);
  VectorXd x(columns.num_values());
  x.head(10 * n_) = StackInertials(values.arm.robot);
  for (int j = 0; j < n_; ++j) {
    for (int t = 0; t < 4; ++t) {
      x[10 * n_ + 4 * j + t] =
          TermOf(kTerms[t], values.arm.robot.links[j].joint);
    }
    x[14 * n_ + j] = values.arm.transitions[j].width;
  }
  x.segment(columns.kp(), 3 * n_) << values.kp, values.kd, values.ki;
  x[columns.delay()] = values.delay;
  return x;
}

LoopValues LoopUnknowns::At(const VectorXd& x) const {
  const LoopColumns columns(n_);
  LoopValues values = files_;
  for (int j = 0; j < n_; ++j) {
    Link& link = values.arm.robot.links[j];
    if (is_free(10 * j)) {
      link.inertial = InertialParameters::FromVector(x.segment<10>(10 * j));
      link.has_inertial = true;
    }
    for (int t = 0; t < 4; ++t) {
      *TermOf(kTerms[t], &link.joint) = x[10 * n_ + 4 * j + t];
    }
    values.arm.transitions[j].width = x[14 * n_ + j];
  }
  values.kp = x.segment(columns.kp(), n_);
  values.kd = x.segment(columns.kd(), n_);
  values.ki = x.segment(columns.ki(), n_);
  values.delay = x[columns.delay()];
  return values;
}

}  // namespace armcal
