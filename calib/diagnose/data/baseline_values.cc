#include <cmath>

#include "calib/diagnose/data/baseline.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The robot at these values, as far as a robot file goes: discrepancy, delay
// and how friction changes sign are in none.
Robot GapBaseline::With(const VectorXd& x) const {
  CHECK_EQ(x.size(), size());
  Robot robot = robot_;
  for (int c = 0; c < size(); ++c) {
    const BaselineColumn& column = columns_[c];
    const double value = x[c] * OwnSpread(column);
    if (column.kind == BaselineColumn::Kind::kInertial) {
      Vector10d v = Vector10d::Zero();
      v[column.index] = value;
      robot.links[column.joint].inertial += InertialParameters::FromVector(v);
    } else if (column.kind == BaselineColumn::Kind::kTerm ||
               column.kind == BaselineColumn::Kind::kDay) {
      *TermOf(static_cast<JointTerm>(column.index),
              &robot.links[column.joint].joint) += value;
    }
  }
  return robot;
}

// How joint j's Coulomb friction changes sign at x: the parts of the mixture,
// whose forces sum up to its Coulomb friction.
std::vector<CoulombPart> GapBaseline::CoulombAt(int j,
                                                const VectorXd& x) const {
  std::vector<CoulombPart> parts = {
      {With(x).links[j].joint.coulomb, transitions_[j]}};
  for (int c = 0; c < size(); ++c) {
    const BaselineColumn& column = columns_[c];
    if (column.kind != BaselineColumn::Kind::kZeroVelocity) continue;
    if (column.joint != j) continue;
    const double force = x[c] * column.spread;
    if (force == 0) continue;
    parts.front().force -= force;
    parts.push_back(
        {force, {CoulombTransition::Law::kVelocity, WidthOf(column)}});
  }
  return parts;
}

// Of its joint's friction, the share that a column of dry friction of the day
// is of per unit; 0: it is none.
double GapBaseline::ShareOfDay(const BaselineColumn& column) const {
  const bool is_of_dry_friction =
      column.kind == BaselineColumn::Kind::kDay &&
      static_cast<JointTerm>(column.index) == JointTerm::kCoulomb;
  return is_of_dry_friction
             ? column.spread / robot_.links[column.joint].joint.coulomb
             : 0;
}

// What a column is of the joint's own term or of the link, SI units per unit.
// Dry friction of another day is another share of all that a joint has of it:
// where a reference showed laws of it, Coulomb friction is what it is beside
// them, which may be less than none, and their sum what robot files have.
double GapBaseline::OwnSpread(const BaselineColumn& column) const {
  const double share = ShareOfDay(column);
  return share == 0 ? column.spread
                    : share * known_.CoulombBeside(
                                  column.joint,
                                  robot_.links[column.joint].joint.coulomb);
}

// The same of those laws: what they are the more, in units of their columns,
// per unit of a column of the day. The share is that of what they were found to
// be; that the logs may have them otherwise is of second order.
VectorXd GapBaseline::LawsOfDay(const BaselineColumn& column) const {
  const auto& parameters = known_.parameters();
  VectorXd more = VectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  const double share = ShareOfDay(column);
  for (size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].joint == column.joint) {
      more[static_cast<Eigen::Index>(k)] = share * parameters[k].dry;
    }
  }
  return more;
}

std::vector<KnownEffect> GapBaseline::KnownAt(const VectorXd& x) const {
  VectorXd values = x.segment(known_begin_, known_.parameters().size());
  for (int c = 0; c < known_begin_; ++c) {
    if (x[c] != 0) values += x[c] * LawsOfDay(columns_[c]);
  }
  return known_.At(values);
}

MatrixXd GapBaseline::FrictionBeyond(const VectorXd& x,
                                     const RecordedTorque& torque) const {
  MatrixXd beyond = MatrixXd::Zero(torque.motion().size(), robot_.num_joints());
  const bool knows = !known_.parameters().empty();
  std::vector<MatrixXd> known;
  if (knows) known = known_.Torques(robot_, torque);
  for (int c = 0; c < num_model_columns(); ++c) {
    const BaselineColumn& column = columns_[c];
    if (x[c] == 0 || column.kind == BaselineColumn::Kind::kInertial ||
        column.kind == BaselineColumn::Kind::kTiming) {
      continue;
    }
    if (column.kind == BaselineColumn::Kind::kEffect) {
      beyond += x[c] * known[c - known_begin_];
    } else {
      beyond.col(column.joint) += x[c] * OwnSpread(column) *
                                  FineColumn(column, column.joint, {}, torque);
    }
  }
  return beyond;
}

double GapBaseline::DelayAt(const VectorXd& x) const {
  double delay = 0;
  for (int c = 0; c < size(); ++c) {
    if (columns_[c].kind == BaselineColumn::Kind::kTiming) {
      delay += x[c] * columns_[c].spread;
    }
  }
  return delay;
}

}  // namespace armcal
