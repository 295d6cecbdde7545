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

// The friction of a trajectory has a motion of its own or that of the joints.
const Eigen::MatrixXd& FrictionPositions(const Trajectory& t) {
  return t.friction_q.size() > 0 ? t.friction_q : t.q;
}
const Eigen::MatrixXd& FrictionVelocities(const Trajectory& t) {
  return t.friction_q.size() > 0 ? t.friction_qd : t.qd;
}

// int tanh(x) dx = ln cosh x + ln 2, without overflow.
double TanhIntegral(double x) {
  return std::abs(x) + std::log1p(std::exp(-2 * std::abs(x)));
}

// The mean of tanh(x / width) where x goes evenly from a to b:
//   width / (b - a) (ln cosh(b / width) - ln cosh(a / width)).
// With c = tanh at the middle, d = (b - a) / width and tanh'' = -2 c (1 - c^2),
// its Taylor series begins with c + d^2 / 24 tanh'', and what follows is below
// d^4 / 1920 max |tanh''''| = .0022 d^4.
double MeanTanh(double a, double b, double width, double c) {
  constexpr double kNear = 0.3;  // by the series, off by 1.7e-5
  constexpr double kFar = 9;     // beyond it tanh is 1 less 3e-8
  const bool passes =
      a * b <= 0 || std::abs(a) < kFar * width || std::abs(b) < kFar * width;
  if (!passes) return c;
  const double d = (b - a) / width;
  if (std::abs(d) < kNear) return c - d * d / 12 * c * (1 - c * c);
  return width / (b - a) * (TanhIntegral(b / width) - TanhIntegral(a / width));
}

// Velocities in the middle of the steps before and after a row (at the ends:
// the row's own), which goes evenly between rows.
void AverageVelocityLaw(const Eigen::Ref<const Eigen::VectorXd>& qd,
                        double width, Eigen::Ref<Eigen::VectorXd> c) {
  const Eigen::Index last = qd.size() - 1;
  for (Eigen::Index k = 0; k <= last; ++k) {
    const double a = k > 0 ? (qd[k - 1] + qd[k]) / 2 : qd[k];
    const double b = k < last ? (qd[k] + qd[k + 1]) / 2 : qd[k];
    c[k] = MeanTanh(a, b, width, c[k]);
  }
}

// The mean of clip(c + s move, -1, 1) over s from 0 to 1: a Prandtl element
// that moves evenly, until it yields.
double MeanClipped(double c, double move) {
  if (std::abs(c + move) <= 1) return c + move / 2;
  const double bound = move > 0 ? 1 : -1;
  const double until = (bound - c) / move;
  return until * (c + bound) / 2 + (1 - until) * bound;
}

// Of the states of a displacement law: the second half of the step before a row
// and the first half of the one after it (at the ends: the one that is there).
void AverageDisplacementLaw(const Eigen::Ref<const Eigen::VectorXd>& q,
                            double width, Eigen::Ref<Eigen::VectorXd> c) {
  const Eigen::Index last = q.size() - 1;
  double before = c[0];  // of the row before
  for (Eigen::Index k = 0; k <= last; ++k) {
    const double own = c[k];
    double mean = own;
    if (k > 0) {
      const double half = (q[k] - q[k - 1]) / (2 * width);
      mean = MeanClipped(std::clamp(before + half, -1., 1.), half);
    }
    if (k < last) {
      const double after = MeanClipped(own, (q[k + 1] - q[k]) / (2 * width));
      mean = k > 0 ? (mean + after) / 2 : after;
    }
    c[k] = mean;
    before = own;
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
  const Eigen::MatrixXd& q = FrictionPositions(trajectory);
  const Eigen::MatrixXd& qd = FrictionVelocities(trajectory);
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

// The motion is taken to go evenly between rows.
Eigen::MatrixXd CoulombStates::FollowTorque(const Trajectory& trajectory) {
  Eigen::MatrixXd means = Follow(trajectory);
  if (!trajectory.thinned || trajectory.size() < 2) return means;
  for (int c = 0; c < size(); ++c) {
    const int j = columns_[c].joint;
    const CoulombTransition& transition = columns_[c].transition;
    if (transition.law == CoulombTransition::Law::kVelocity) {
      AverageVelocityLaw(FrictionVelocities(trajectory).col(j),
                         transition.width, means.col(c));
    } else {
      AverageDisplacementLaw(FrictionPositions(trajectory).col(j),
                             transition.width, means.col(c));
    }
  }
  return means;
}

}  // namespace armcal
