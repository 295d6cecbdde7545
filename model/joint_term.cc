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

double CoulombStates::Initial(const Trajectory& trajectory, int column) const {
  const long row = trajectory.first_index - first_index_;
  if (trajectory.segment != segment_ || row < 0 || row >= states_.rows()) {
    return 0;
  }
  return states_(row, column);
}

const Eigen::MatrixXd& CoulombStates::Follow(const Trajectory& trajectory) {
  Eigen::MatrixXd states(trajectory.size(), size());
  for (int c = 0; c < size() && trajectory.size() > 0; ++c) {
    const int j = columns_[c].joint;
    const CoulombTransition& transition = columns_[c].transition;
    if (transition.law == CoulombTransition::Law::kVelocity) {
      states.col(c) = (trajectory.qd.col(j).array() / transition.width).tanh();
      continue;
    }
    states(0, c) = Initial(trajectory, c);
    for (int k = 1; k < trajectory.size(); ++k) {
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
