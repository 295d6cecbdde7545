#include "model/dynamics/joint_term.h"

#include <algorithm>
#include <cmath>

#include "model/simd/kernels.h"

namespace armcal {

namespace {

constexpr int kTogether = 8;
using Widths = Eigen::Array<double, kTogether, 1>;

// How many columns from `c` on are followed in one go: those of a joint's
// displacement law.
int NumTogether(const std::vector<JointTermColumn>& columns, int c) {
  const JointTermColumn& first = columns[c];
  const CoulombTransition::Law law = first.transition.law;
  if (law == CoulombTransition::Law::kVelocity) return 1;
  int count = 1;
  for (; count < kTogether && c + count < static_cast<int>(columns.size());
       ++count) {
    const JointTermColumn& next = columns[c + count];
    if (next.joint != first.joint || next.transition.law != law) break;
  }
  return count;
}

// Of laws side by side, none of which waits for another: the rows from `begin`
// on, each from the one before.
void FollowDisplacement(const Eigen::Ref<const Eigen::VectorXd>& q,
                        const Widths& widths, int begin,
                        Eigen::Ref<Eigen::MatrixXd> states) {
  const Eigen::Index count = states.cols();
  Widths c = Widths::Zero();
  c.head(count) = states.row(begin - 1);
  for (Eigen::Index k = begin; k < states.rows(); ++k) {
    const Widths step = Widths::Constant(q[k] - q[k - 1]) / widths;
    c = (c + step).max(-1).min(1);
    for (Eigen::Index m = 0; m < count; ++m) states(k, m) = c[m];
  }
}

}  // namespace

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

// c of every Coulomb column along a trajectory: tanh(qd / width), or the state
// of a displacement law, which has a memory. It goes on from the trajectory
// before where both overlap; else it begins at 0.
const Eigen::MatrixXd& CoulombStates::Follow(const Trajectory& trajectory) {
  const bool apart = trajectory.friction_q.size() > 0;
  const Eigen::MatrixXd& q = apart ? trajectory.friction_q : trajectory.q;
  const Eigen::MatrixXd& qd = apart ? trajectory.friction_qd : trajectory.qd;
  Eigen::MatrixXd states(trajectory.size(), size());
  const int known = NumKnown(trajectory);
  const Eigen::Index shift = trajectory.first_index - first_index_;
  for (int c = 0; c < size() && trajectory.size() > 0;) {
    const int count = NumTogether(columns_, c), j = columns_[c].joint;
    const CoulombTransition& transition = columns_[c].transition;
    auto of_these = states.middleCols(c, count);
    if (transition.law == CoulombTransition::Law::kVelocity) {
      simd::BestKernels().hyperbolic_tangent(qd.col(j).data(), transition.width,
                                             trajectory.size(),
                                             of_these.data());
    } else {
      of_these.row(0).setZero();
      if (known > 0) {
        of_these.topRows(known) = states_.block(shift, c, known, count);
      }
      Widths widths = Widths::Ones();
      for (int k = 0; k < count; ++k) {
        widths[k] = columns_[c + k].transition.width;
      }
      FollowDisplacement(q.col(j), widths, std::max(1, known), of_these);
    }
    c += count;
  }
  states_ = std::move(states);
  segment_ = trajectory.segment;
  first_index_ = trajectory.first_index;
  return states_;
}

}  // namespace armcal
