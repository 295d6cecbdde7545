#include "calib/diagnose/data/baseline.h"

#include <glog/logging.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "calib/diagnose/data/calibrated_prior.h"
#include "calib/diagnose/data/day_shares.h"
#include "calib/diagnose/data/thresholds.h"
#include "model/dynamics/batch_regressor.h"
#include "model/signals/low_pass.h"
#include "model/signals/recording_delay.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Widths of tanh(qd / width), rad/s (0.3 of it in m/s): friction changes sign
// as the first, or a calibrated one, or as any mixture of it and others, which
// are so many times as wide.
constexpr std::array<double, 5> kOtherWidths = {.25, .5, 2, 4, 8};

double WidthUnit(const Joint& joint) {
  return IsRotational(joint.type) ? 1 : .3;
}

// Torque of joint j per unit of the inertial parameters of links j to n, which
// are those that it moves: per joint, samples x 10 (n - j). By Lagrange's
// equations
//   tau = d/dt (P phi) - D phi,  P phi = dT/dqd,  D phi = dT/dq - dV/dq,
// the momentum form of the regressor, which takes one numeric derivative of
// what is smooth in time instead of products with noisy accelerations.
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

// How joint j's Coulomb friction changes sign. A calibrated width counts where
// it is one of velocity, down to the narrowest mixture about the usual one:
// others differ only where a joint is slower than recorded velocities tell.
CoulombTransition TransitionOf(const Robot& robot, int j,
                               const BaselineOptions& options) {
  CoulombTransition transition;
  transition.width = Limits().reversal_width * WidthUnit(robot.links[j].joint);
  if (options.transitions.empty()) return transition;
  const CoulombTransition& calibrated = options.transitions[j];
  if (calibrated.law == CoulombTransition::Law::kVelocity) {
    transition.width =
        std::max(calibrated.width, kOtherWidths[0] * transition.width);
  }
  return transition;
}

// A size that an offset of a joint's torque may have, N m or N.
double UsualOffset(const Joint& joint, double usual_torque) {
  return std::max(std::abs(joint.coulomb),
                  Limits().offset_share * usual_torque);
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

// The columns that a model of rigid links may vary, each scaled by its prior's
// standard deviation, so that their values are N(0, 1): inertial parameters and
// joint terms by the trust in the file, mixtures of how friction changes sign,
// the time at which it does, and a delay that all torques share. A
// calibration's posterior replaces the prior of the parameters that it told,
// with all of their correlations.
GapBaseline::GapBaseline(const Robot& robot, const BaselineOptions& options,
                         const VectorXd& usual_torque)
    : robot_(robot), usual_torque_(usual_torque) {
  const int n = robot.num_joints();
  CHECK_EQ(usual_torque.size(), n);
  for (int j = 0; j < n; ++j) {
    transitions_.push_back(TransitionOf(robot, j, options));
    AddLink(j, options);
    AddTerms(j, options, usual_torque[j]);
    AddReversal(j, options.reversal_s);
  }
  columns_.push_back({BaselineColumn::Kind::kTiming, -1, 0, options.timing_s});
  if (options.posterior == nullptr) return;
  prior_ = CalibratedPrior(*options.posterior, options.posterior_deviations,
                           robot_, columns_, options.of_another_day);
}

GapBaseline GapBaseline::MovedTo(const VectorXd& x) const {
  GapBaseline moved = *this;
  moved.robot_ = With(x);
  moved.prior_.MoveZeroTo(x);
  return moved;
}

// Viscous and Coulomb friction of the diagnosed day, beside that of the
// reference: their prior is the scatter from day to day, a share of the
// friction itself (day_shares.h). Zeros of torques wander, too: by a size that
// the sensor or the drive has, for which there is no rule, so that theirs is
// wide (UsualOffset) and they are held until several joints show them
// (HaveZerosMoved).
void GapBaseline::FreeDays() {
  for (int j = 0; j < robot_.num_joints(); ++j) {
    for (const auto& [term, share] : kShareOfDays) {
      const double spread =
          share * std::abs(TermOf(term, robot_.links[j].joint));
      if (spread <= 0) continue;
      columns_.push_back(
          {BaselineColumn::Kind::kDay, j, static_cast<int>(term), spread});
    }
    const double spread = UsualOffset(robot_.links[j].joint, usual_torque_[j]);
    if (spread <= 0) continue;
    columns_.push_back({BaselineColumn::Kind::kDay, j,
                        static_cast<int>(JointTerm::kOffset), spread});
  }
}

void GapBaseline::AddKnown(const KnownEffects& known) {
  CHECK(known_.parameters().empty());
  CHECK_EQ(num_model_columns(), size());
  known_ = known;
  known_begin_ = size();
  for (const KnownEffects::Parameter& parameter : known.parameters()) {
    columns_.push_back({BaselineColumn::Kind::kEffect, parameter.joint,
                        parameter.index, parameter.spread});
  }
}

void GapBaseline::AddDiscrepancy(const Discrepancy& discrepancy) {
  CHECK_EQ(num_model_columns(), size());
  discrepancy_ = discrepancy;
  for (int j = 0; j < robot_.num_joints(); ++j) {
    const Eigen::VectorXd spreads =
        discrepancy_.Spreads(j, robot_.links[j].joint);
    for (int k = 0; k < spreads.size(); ++k) {
      columns_.push_back(
          {BaselineColumn::Kind::kDiscrepancy, j, k, spreads[k]});
    }
  }
}

GapBaseline GapBaseline::WithoutDiscrepancy() const {
  GapBaseline without = *this;
  without.columns_.resize(num_model_columns());
  without.discrepancy_ = {};
  return without;
}

int GapBaseline::num_model_columns() const {
  int count = size();
  while (count > 0 &&
         columns_[count - 1].kind == BaselineColumn::Kind::kDiscrepancy) {
    --count;
  }
  return count;
}

// The prior of a link's ten inertial parameters is `trust` of its mass, of its
// mass times its size for the first moments, and of its mass times the square
// of its size for the inertias, with size^2 = tr(I) / (2 m) the mean squared
// distance of the mass from the link's origin. A parameter that is 0 in the
// file is thus as uncertain as one that is not.
void GapBaseline::AddLink(int link, const BaselineOptions& options) {
  const Robot& file = options.file != nullptr ? *options.file : robot_;
  const InertialParameters& inertial = file.links[link].inertial;
  if (inertial.mass <= 0) return;
  const double size = std::sqrt(inertial.inertia.trace() / 2 / inertial.mass);
  for (int k = 0; k < 10; ++k) {
    const double lever = k == 0 ? 1 : k < 4 ? size : size * size;
    columns_.push_back({BaselineColumn::Kind::kInertial, link, k,
                        options.trust * inertial.mass * lever});
  }
}

// Friction, armature and torque's zero of joint j. Terms that the file gives no
// joint are open to the size that MissingTermFit calls usual, those of the file
// by their own size times `trust`, and those that a calibration found to be 0
// by its standard deviation. Where friction changes sign there is one column
// per width beside the joint's own (kOtherWidths), each the difference of two
// curves: a mixture of widths is a law of its own, of which no single width
// would do.
void GapBaseline::AddTerms(int j, const BaselineOptions& options,
                           double usual_torque) {
  const Joint& joint = robot_.links[j].joint;
  const auto add = [&](JointTerm term, double size) {
    const auto missing = options.missing_terms.find(term);
    double spread = missing == options.missing_terms.end()
                        ? options.trust * std::abs(size)
                        : missing->second[j];
    // What a calibration found to be 0 is not known to be that.
    if (spread <= 0 && options.posterior != nullptr) {
      spread = options.posterior->Stddev(j, term);
    }
    if (spread <= 0) return;
    columns_.push_back(
        {BaselineColumn::Kind::kTerm, j, static_cast<int>(term), spread});
  };
  add(JointTerm::kArmature, joint.armature);
  add(JointTerm::kViscous, joint.viscous);
  add(JointTerm::kCoulomb, joint.coulomb);
  // A file that was made by measuring friction has its zero as well as that.
  if (options.missing_terms.empty()) {
    add(JointTerm::kOffset, UsualOffset(joint, usual_torque));
  } else {
    add(JointTerm::kOffset,
        Limits().offset_share * usual_torque / options.trust);
  }
  if (joint.coulomb == 0) return;
  for (size_t k = 0; k < kOtherWidths.size(); ++k) {
    columns_.push_back({BaselineColumn::Kind::kZeroVelocity, j,
                        static_cast<int>(k),
                        Limits().width_mixture * joint.coulomb});
  }
}

// Coulomb friction changes sign when the joint's velocity does, and the
// recorded one passes 0 at another time where a low pass takes a stop for a
// turn. To first order that is minus its derivative in time, times a time that
// is N(0, timing^2).
void GapBaseline::AddReversal(int j, double timing) {
  const double spread = timing * robot_.links[j].joint.coulomb;
  if (spread <= 0) return;
  columns_.push_back({BaselineColumn::Kind::kReversal, j, 0, spread});
}

VectorXd GapBaseline::LateReversals(int j, const RecordedTorque& torque) const {
  const Motion& motion = torque.motion();
  return -Differentiate(
      TermTorque(JointTerm::kCoulomb, transitions_[j], motion, j), motion.dt);
}

// Joint j's torque per unit of a column; empty where it has none. An inertial
// parameter of link k acts on all joints up to it, others on their own joint
// only; the column of the delay is the slope of the torque in time, on all
// joints.
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
      return own ? LateReversals(j, torque) : VectorXd();
    case BaselineColumn::Kind::kTiming:
      return SlopeByDelay(torque.nominal().col(j), motion.torque.OfJoint(j),
                          motion.dt);
    case BaselineColumn::Kind::kEffect:
    case BaselineColumn::Kind::kDiscrepancy:
      break;
  }
  return {};
}

// Joint j's torque per unit of all columns in a segment, those that act on it,
// times their spreads. Known effects and the discrepancy come last and are
// evaluated together, since their shapes share the motion.
BaselineColumns GapBaseline::FineColumns(int j, const GapSegment& segment,
                                         const MatrixXd& inertial,
                                         const std::vector<MatrixXd>& known,
                                         const RecordedTorque& torque) const {
  const int samples = segment.size(), model = num_model_columns();
  BaselineColumns fine;
  std::vector<VectorXd> columns;
  const auto add = [&](int c, VectorXd column) {
    fine.which.push_back(c);
    columns.push_back(std::move(column));
  };
  for (int c = 0; c < model; ++c) {
    if (columns_[c].kind == BaselineColumn::Kind::kEffect) {
      add(c, known[c - known_begin_].col(j));
      continue;
    }
    VectorXd column = FineColumn(columns_[c], j, inertial, torque);
    if (column.size() == 0) continue;
    column *= OwnSpread(columns_[c]);
    const VectorXd laws = LawsOfDay(columns_[c]);
    for (Eigen::Index k = 0; k < laws.size(); ++k) {
      if (laws[k] != 0) column += laws[k] * known[k].col(j);
    }
    add(c, std::move(column));
  }
  MatrixXd own;
  for (int c = model; c < size(); ++c) {
    if (columns_[c].joint != j) continue;
    if (own.size() == 0) own = discrepancy_.Torque(j, segment, torque);
    add(c, columns_[c].spread * own.col(columns_[c].index));
  }
  fine.values.resize(samples, static_cast<Eigen::Index>(columns.size()));
  for (size_t k = 0; k < columns.size(); ++k) fine.values.col(k) = columns[k];
  return fine;
}

// Columns are low-passed and thinned exactly as the recorded torque is: a
// filter is linear, so that the filtered torque is the same linear function of
// the parameters.
std::vector<BaselineColumns> GapBaseline::ThinColumns(
    const GapRows& rows, const std::vector<RecordedTorque>& torques) const {
  const int n = robot_.num_joints();
  std::vector<BaselineColumns> thin(n);
  for (size_t i = 0; i < torques.size(); ++i) {
    const int s = static_cast<int>(i), begin = rows.thin_begin(s);
    const Motion& motion = torques[i].motion();
    const std::vector<MatrixXd> inertial = InertialTorque(robot_, motion);
    const std::vector<MatrixXd> known = known_.Torques(robot_, torques[i]);
    tbb::parallel_for(0, n, [&](int j) {
      BaselineColumns fine =
          FineColumns(j, rows.segments()[i], inertial[j], known, torques[i]);
      const MatrixXd low = rows.Thin(s, fine.values);
      if (i == 0) {
        thin[j].which = std::move(fine.which);
        thin[j].values.resize(rows.num_thin(), low.cols());
      }
      thin[j].values.middleRows(begin, low.rows()) = low;
    });
  }
  return thin;
}

double GapBaseline::WidthOf(const BaselineColumn& column) const {
  return kOtherWidths[column.index] * transitions_[column.joint].width;
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
