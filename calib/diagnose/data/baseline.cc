#include "calib/diagnose/data/baseline.h"

#include <glog/logging.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <utility>

#include "model/dynamics/batch_regressor.h"
#include "model/signals/low_pass.h"
#include "model/signals/recording_delay.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Widths of tanh(qd / width), rad/s (0.3 of it in m/s): friction changes sign
// as the first, or as any mixture of it and the others.
constexpr double kReferenceWidth = 6e-3;
constexpr std::array<double, 5> kOtherWidths = {1.5e-3, 3e-3, 12e-3, 24e-3,
                                                48e-3};
// Of the joint's Coulomb friction, how much may change sign otherwise.
constexpr double kMixture = .5;
// Scatter of friction from one day to the next: a UR10e's in eight logs of a
// month (shared/data/ur10e_free/SOURCE.md), ranges over 2.85.
constexpr std::array<std::pair<JointTerm, double>, 2> kShareOfDays = {
    {{JointTerm::kViscous, .1}, {JointTerm::kCoulomb, .06}}};
// A torque's zero is not known better than this share of its usual size.
constexpr double kOffsetShare = .02;

double WidthUnit(const Joint& joint) {
  return IsRotational(joint.type) ? 1 : .3;
}

// Torque of joint j per unit of the inertial parameters of links j to n, which
// are those that it moves: per joint, samples x 10 (n - j).
std::vector<MatrixXd> InertialTorque(const Robot& robot, const Motion& motion) {
  const int n = robot.num_joints();
  const BatchRegressor regressor(robot);
  std::vector<MatrixXd> momentum, force;
  std::vector<double*> P, D;
  for (int j = 0; j < n; ++j) {
    for (auto* list : {&momentum, &force}) {
      list->emplace_back(motion.size(), regressor.row_size(j));
    }
    P.push_back(momentum[j].data());
    D.push_back(force[j].data());
  }
  regressor.Momentum({motion.q, motion.qd, MatrixXd(), MatrixXd()},
                     motion.size(), P.data(), D.data(), motion.size());
  tbb::parallel_for(0, n, [&](int j) {
    momentum[j] = Differentiate(momentum[j], motion.dt) - force[j];
  });
  return momentum;
}

VectorXd TermTorque(JointTerm term, const CoulombTransition& transition,
                    const Motion& motion, int j) {
  switch (term) {
    case JointTerm::kArmature:
      return motion.qdd.col(j);
    case JointTerm::kViscous:
      return motion.qd.col(j);
    case JointTerm::kCoulomb:
      return (motion.qd.col(j).array() / transition.width).tanh();
    case JointTerm::kOffset:
      break;
  }
  return VectorXd::Ones(motion.size());
}

}  // namespace

GapBaseline::GapBaseline(const Robot& robot, const BaselineOptions& options,
                         const VectorXd& usual_torque)
    : robot_(robot) {
  const int n = robot.num_joints();
  CHECK_EQ(usual_torque.size(), n);
  for (int j = 0; j < n; ++j) {
    CoulombTransition transition;
    transition.width = kReferenceWidth * WidthUnit(robot.links[j].joint);
    transitions_.push_back(transition);
    AddLink(j, options.trust);
    AddTerms(j, options.joint_trust.value_or(options.trust), usual_torque[j]);
    AddReversal(j, options.reversal_s);
  }
  columns_.push_back({BaselineColumn::Kind::kTiming, -1, 0, options.timing_s});
}

GapBaseline GapBaseline::MovedTo(const VectorXd& x) const {
  GapBaseline moved = *this;
  moved.robot_ = With(x);
  return moved;
}

void GapBaseline::FreeDays() {
  for (int j = 0; j < robot_.num_joints(); ++j) {
    for (const auto& [term, share] : kShareOfDays) {
      const double spread =
          share * std::abs(TermOf(term, robot_.links[j].joint));
      if (spread <= 0) continue;
      columns_.push_back(
          {BaselineColumn::Kind::kDay, j, static_cast<int>(term), spread});
    }
  }
}

void GapBaseline::AddKnown(const KnownEffects& known) {
  CHECK(known_.parameters().empty());
  known_ = known;
  for (const KnownEffects::Parameter& parameter : known.parameters()) {
    columns_.push_back({BaselineColumn::Kind::kEffect, parameter.joint,
                        parameter.index, parameter.spread});
  }
}

void GapBaseline::AddLink(int link, double trust) {
  const InertialParameters& inertial = robot_.links[link].inertial;
  if (inertial.mass <= 0) return;
  const double size = std::sqrt(inertial.inertia.trace() / 2 / inertial.mass);
  for (int k = 0; k < 10; ++k) {
    const double lever = k == 0 ? 1 : k < 4 ? size : size * size;
    columns_.push_back({BaselineColumn::Kind::kInertial, link, k,
                        trust * inertial.mass * lever});
  }
}

void GapBaseline::AddTerms(int j, double trust, double usual_torque) {
  const Joint& joint = robot_.links[j].joint;
  const auto add = [&](JointTerm term, double spread) {
    if (spread <= 0) return;
    columns_.push_back(
        {BaselineColumn::Kind::kTerm, j, static_cast<int>(term), spread});
  };
  add(JointTerm::kArmature, trust * std::abs(joint.armature));
  add(JointTerm::kViscous, trust * std::abs(joint.viscous));
  add(JointTerm::kCoulomb, trust * std::abs(joint.coulomb));
  add(JointTerm::kOffset,
      trust * std::max(std::abs(joint.coulomb), kOffsetShare * usual_torque));
  if (joint.coulomb == 0) return;
  for (size_t k = 0; k < kOtherWidths.size(); ++k) {
    columns_.push_back({BaselineColumn::Kind::kZeroVelocity, j,
                        static_cast<int>(k), kMixture * joint.coulomb});
  }
}

void GapBaseline::AddReversal(int j, double timing) {
  const double spread = timing * robot_.links[j].joint.coulomb;
  if (spread <= 0) return;
  columns_.push_back({BaselineColumn::Kind::kReversal, j, 0, spread});
}

// Joint j's torque per unit of a column; empty where it has none.
VectorXd GapBaseline::FineColumn(const BaselineColumn& column, int j,
                                 const MatrixXd& inertial,
                                 const RecordedTorque& torque) const {
  const Motion& motion = torque.motion();
  const bool own = column.joint == j;
  switch (column.kind) {
    case BaselineColumn::Kind::kInertial:
      if (column.joint < j) return {};
      return inertial.col(10 * (column.joint - j) + column.index);
    case BaselineColumn::Kind::kTerm:
    case BaselineColumn::Kind::kDay:
      if (!own) return {};
      return TermTorque(static_cast<JointTerm>(column.index), transitions_[j],
                        motion, j);
    case BaselineColumn::Kind::kZeroVelocity: {
      if (!own) return {};
      CoulombTransition other;
      other.width = WidthOf(column);
      return TermTorque(JointTerm::kCoulomb, other, motion, j) -
             TermTorque(JointTerm::kCoulomb, transitions_[j], motion, j);
    }
    case BaselineColumn::Kind::kReversal:
      if (!own) return {};
      return -Differentiate(
          TermTorque(JointTerm::kCoulomb, transitions_[j], motion, j),
          motion.dt);
    case BaselineColumn::Kind::kTiming:
      return SlopeByDelay(torque.nominal().col(j), motion.torque.OfJoint(j),
                          motion.dt);
    case BaselineColumn::Kind::kEffect:
      break;
  }
  return {};
}

std::vector<MatrixXd> GapBaseline::ThinColumns(
    const GapRows& rows, const std::vector<RecordedTorque>& torques) const {
  const int n = robot_.num_joints();
  std::vector<MatrixXd> thin(n, MatrixXd(rows.num_thin(), size()));
  for (size_t i = 0; i < torques.size(); ++i) {
    const int s = static_cast<int>(i);
    const Motion& motion = torques[i].motion();
    const std::vector<MatrixXd> inertial = InertialTorque(robot_, motion);
    const std::vector<MatrixXd> known = known_.Torques(robot_, torques[i]);
    tbb::parallel_for(0, n, [&](int j) {
      std::vector<int> which;
      std::vector<VectorXd> columns;
      const auto add = [&](int c, VectorXd column) {
        if (column.size() == 0 || column.isZero(0)) return;
        which.push_back(c);
        columns.push_back(std::move(column));
      };
      for (int c = 0; c < size(); ++c) {
        add(c, columns_[c].spread *
                   FineColumn(columns_[c], j, inertial[j], torques[i]));
      }
      for (size_t k = 0; k < known.size(); ++k) {
        add(static_cast<int>(size() - known.size() + k), known[k].col(j));
      }
      MatrixXd fine(motion.size(), columns.size());
      for (size_t k = 0; k < columns.size(); ++k) fine.col(k) = columns[k];
      const MatrixXd low = rows.Thin(s, fine);
      auto here = thin[j].middleRows(rows.thin_begin(s), low.rows());
      here.setZero();
      for (size_t k = 0; k < which.size(); ++k) here.col(which[k]) = low.col(k);
    });
  }
  return thin;
}

double GapBaseline::WidthOf(const BaselineColumn& column) const {
  return kOtherWidths[column.index] *
         WidthUnit(robot_.links[column.joint].joint);
}

Robot GapBaseline::With(const VectorXd& x) const {
  CHECK_EQ(x.size(), size());
  Robot robot = robot_;
  for (int c = 0; c < size(); ++c) {
    const BaselineColumn& column = columns_[c];
    const double value = x[c] * column.spread;
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

std::vector<KnownEffect> GapBaseline::KnownAt(const VectorXd& x) const {
  return known_.At(x.tail(known_.parameters().size()));
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

std::vector<RecordedTorque> RecordedTorques(const GapBaseline& baseline,
                                            const GapRows& rows) {
  std::vector<RecordedTorque> torques;
  for (const GapSegment& segment : rows.segments()) {
    torques.emplace_back(baseline.robot(), baseline.transitions(),
                         segment.motion);
  }
  return torques;
}

}  // namespace armcal
