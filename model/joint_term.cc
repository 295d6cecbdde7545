#include "model/joint_term.h"

#include <algorithm>
#include <cmath>

namespace armcal {

const char* JointTermName(JointTerm term) {
  switch (term) {
    case JointTerm::kViscous:
      return "viscous";
    case JointTerm::kCoulomb:
      return "coulomb";
    case JointTerm::kOffset:
      return "offset";
    case JointTerm::kArmature:
      return "armature";
  }
  return "";
}

double* TermOf(JointTerm term, Joint* joint) {
  switch (term) {
    case JointTerm::kViscous:
      return &joint->viscous;
    case JointTerm::kCoulomb:
      return &joint->coulomb;
    case JointTerm::kOffset:
      return &joint->offset;
    case JointTerm::kArmature:
      return &joint->armature;
  }
  return nullptr;
}

double TermOf(JointTerm term, Joint joint) { return *TermOf(term, &joint); }

std::string JointTermUnit(JointTerm term, JointType type) {
  const std::string effort = EffortUnit(type);
  switch (term) {
    case JointTerm::kViscous:
      return effort + " s/" + PositionUnit(type);
    case JointTerm::kArmature:
      return IsRotational(type) ? "kg m^2" : "kg";
    case JointTerm::kCoulomb:
    case JointTerm::kOffset:
      break;
  }
  return effort;
}

double CoulombTransition::C(double qd, double state) const {
  return law == Law::kVelocity ? std::tanh(qd / width)
                               : std::clamp(state, -1.0, 1.0);
}

double CoulombTransition::StateRate(double qd, double state) const {
  // A Prandtl element that has yielded stays where it is.
  const bool yields = std::abs(state) >= 1 && state * qd > 0;
  return law == Law::kVelocity || yields ? 0 : qd / width;
}

double FrictionTorque(const Joint& joint, const CoulombTransition& transition,
                      double qd, double state) {
  return joint.viscous * qd + joint.coulomb * transition.C(qd, state) +
         joint.offset;
}

double JointTermColumn::D(double qd, double c) const {
  switch (term) {
    case JointTerm::kViscous:
      return -qd;
    case JointTerm::kCoulomb:
      return -c;
    case JointTerm::kOffset:
      return -1;
    case JointTerm::kArmature:
      return 0;
  }
  return 0;
}

double JointTermColumn::Torque(double qd, double qdd, double c) const {
  return (term == JointTerm::kArmature ? qdd : 0) - D(qd, c);
}

CoulombStates::CoulombStates(const std::vector<JointTermColumn>& columns) {
  for (const JointTermColumn& column : columns) {
    if (column.term == JointTerm::kCoulomb) columns_.push_back(column);
  }
}

// How many of the trajectory's samples, up to the first of its core, have
// states from the trajectory before.
int CoulombStates::NumKnown(const Trajectory& trajectory) const {
  const long shift = trajectory.first_index - first_index_;
  if (trajectory.segment != segment_ || shift < 0) return 0;
  return static_cast<int>(
      std::clamp(states_.rows() - shift, 0L,
                 std::min(trajectory.core_begin + 1L, 0L + trajectory.size())));
}

const Eigen::MatrixXd& CoulombStates::Follow(const Trajectory& trajectory) {
  Eigen::MatrixXd states(trajectory.size(), size());
  const int known = NumKnown(trajectory);
  const Eigen::Index shift = trajectory.first_index - first_index_;
  for (int c = 0; c < size() && trajectory.size() > 0; ++c) {
    const int j = columns_[c].joint;
    const CoulombTransition& transition = columns_[c].transition;
    if (transition.law == CoulombTransition::Law::kVelocity) {
      states.col(c) = (trajectory.qd.col(j).array() / transition.width).tanh();
      continue;
    }
    states(0, c) = 0;
    if (known > 0) {
      states.col(c).head(known) = states_.col(c).segment(shift, known);
    }
    for (int k = std::max(1, known); k < trajectory.size(); ++k) {
      const double moved = trajectory.q(k, j) - trajectory.q(k - 1, j);
      states(k, c) =
          std::clamp(states(k - 1, c) + moved / transition.width, -1.0, 1.0);
    }
  }
  states_ = std::move(states);
  segment_ = trajectory.segment;
  first_index_ = trajectory.first_index;
  return states_;
}

}  // namespace armcal
