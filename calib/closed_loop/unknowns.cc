#include "calib/closed_loop/unknowns.h"

#include <glog/logging.h>

#include <algorithm>

#include "model/dynamics/drive_law.h"
#include "problems/link_functions.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kAny = -1;

const DriveParameter& ParameterOf(double DriveLaw::*gain) {
  for (const DriveParameter& parameter : DriveParameters()) {
    if (parameter.value == gain) return parameter;
  }
  LOG(FATAL) << "no such gain";
}

}  // namespace

// A prior of 0 holds a value. The width of Coulomb friction stays above a tenth
// of its start, for which the simulation's substeps are chosen. No command is
// followed before it is given: its delay is not negative.
LoopUnknowns::LoopUnknowns(const LoopValues& nominal, DriveKind kind,
                           const LoopTrust& trust,
                           const std::vector<JointTerm>& joint_terms,
                           const VectorXd& torque_rms)
    : n_(nominal.arm.robot.num_joints()), files_(nominal) {
  const Robot& robot = nominal.arm.robot;
  for (const Link& link : robot.links) {
    // A link between two joints of one body has no mass that may vary.
    const double inertia = IsDeclaredMassless(link) ? 0 : trust.inertia;
    for (int k = 0; k < 10; ++k) {
      Add(link.name + "." + InertialName(k), InertialUnit(k), inertia, kAny);
    }
  }
  for (int j = 0; j < n_; ++j) {
    const Joint& joint = robot.links[j].joint;
    for (const JointTerm term : kLoopTerms) {
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
  AddGains(kind, trust.gains);
  Add("drive.delay", "s", trust.delay, 0);
  nominal_ = Stack(nominal);
}

// Adds the drives' gains; those that drives of this kind do not have get no
// name.
void LoopUnknowns::AddGains(DriveKind kind, double trust) {
  for (double DriveLaw::*gain : EstimatedGains()) {
    const DriveParameter& parameter = ParameterOf(gain);
    for (int j = 0; j < n_; ++j) {
      const Joint& joint = files_.arm.robot.links[j].joint;
      const bool has = HasParameter(kind, parameter);
      Add(has ? joint.name + "." + parameter.name : "",
          IsRotational(joint.type) ? parameter.unit : parameter.linear_unit,
          trust * files_.drives[j].*gain, 0);
    }
  }
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
  const LoopOrder order(n_);
  VectorXd x(order.size());
  x.head(10 * n_) = StackInertials(values.arm.robot);
  for (int j = 0; j < n_; ++j) {
    for (int t = 0; t < 4; ++t) {
      x[order.terms() + 4 * j + t] =
          TermOf(kLoopTerms[t], values.arm.robot.links[j].joint);
    }
    x[order.widths() + j] = values.arm.transitions[j].width;
  }
  int k = order.gains();
  for (double DriveLaw::*gain : EstimatedGains()) {
    for (const DriveLaw& drive : values.drives) x[k++] = drive.*gain;
  }
  x[order.delay()] = values.delay;
  return x;
}

LoopValues LoopUnknowns::At(const VectorXd& x) const {
  const LoopOrder order(n_);
  LoopValues values = files_;
  for (int j = 0; j < n_; ++j) {
    Link& link = values.arm.robot.links[j];
    if (is_free(10 * j)) {
      link.inertial = InertialParameters::FromVector(x.segment<10>(10 * j));
      link.has_inertial = true;
    }
    for (int t = 0; t < 4; ++t) {
      *TermOf(kLoopTerms[t], &link.joint) = x[order.terms() + 4 * j + t];
    }
    values.arm.transitions[j].width = x[order.widths() + j];
  }
  int k = order.gains();
  for (double DriveLaw::*gain : EstimatedGains()) {
    for (DriveLaw& drive : values.drives) drive.*gain = x[k++];
  }
  values.delay = x[order.delay()];
  return values;
}

}  // namespace armcal
