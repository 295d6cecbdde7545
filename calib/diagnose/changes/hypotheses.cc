#include "calib/diagnose/changes/hypotheses.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "calib/diagnose/changes/series_scatter.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Changes of a series, by what is thought of them before: the temperature of
// all friction, one joint's friction, a mass (half of them on the last link),
// everything else.
constexpr double kShareOfAllFriction = .25, kShareOfFriction = .3,
                 kShareOfMass = .25, kShareOfOther = .2;
// Standard deviations of changes: of friction relative to itself; of all else
// (and of friction that there is none of) relative to the joint's usual torque.
constexpr double kFrictionChange = .5, kTorqueChange = .2, kNewFriction = .05;
// By which joints' factors differ where all friction changes: a fifth of it, as
// the joints of a warming arm do (-20 to -25 %, shared/data/schunk_lwa4p).
constexpr double kOwnFactor = .1;
// All torques: the field of magnets that warm by 50 K falls by 5 to 10 %, units
// and supplies make more; motors of one arm differ little.
constexpr double kAllScalesChange = .1, kOwnScale = .02;

// What makes a hypothesis of directions in the parameters.
class Maker {
 public:
  Maker(const Robot& robot, const LogSeries& series, const MatrixXd& levels,
        std::vector<NamedHypothesis>* all)
      : robot_(robot),
        series_(series),
        levels_(levels),
        level_(levels.col(0)),
        all_(all) {
    nominal_ = series.parameters.Values(robot);
  }

  // What a change of the robot does, per unit of it.
  VectorXd Direction(const std::function<void(Robot*)>& change) const {
    Robot changed = robot_;
    change(&changed);
    return (series_.parameters.Values(changed) - nominal_)
        .cwiseQuotient(series_.torque);
  }
  // Adds a hypothesis of such directions, the same in all logs.
  void Add(NamedHypothesis named, const MatrixXd& directions) {
    named.directions.assign(series_.equations.size(), directions);
    Add(std::move(named));
  }
  void Add(NamedHypothesis named) {
    for (size_t l = 0; l < series_.equations.size(); ++l) {
      named.change.columns.push_back(series_.equations[l].root *
                                     named.directions[l]);
    }
    const MatrixXd& directions = named.directions[0];
    if (named.change.scatter.empty()) {
      for (Eigen::Index k = 0; k < directions.rows(); ++k) {
        if (directions.row(k).norm() > 1e-9) {
          named.change.scatter.push_back(static_cast<int>(k));
        }
      }
    }
    if (named.told.size() == 0) {
      named.told = MatrixXd::Identity(directions.cols(), directions.cols());
    }
    if (directions.norm() > 0) Keep(std::move(named));
  }
  // Adds one that changes no parameter of the arm, with its columns.
  void AddOfTorque(NamedHypothesis named) {
    named.directions.assign(
        series_.equations.size(),
        MatrixXd::Zero(level_.size(), named.change.prior.size()));
    Keep(std::move(named));
  }
  // Of the joint; of all where all change; of a mass those that move its link.
  MatrixXd MotionOf(ChangedPart part, int joint) const {
    const bool whole = joint < 0, mass = part == ChangedPart::kMass;
    const int first = whole || mass ? 0 : joint;
    const int last = whole ? robot_.num_joints() - 1 : joint;
    return MotionMeasures(series_.motions, first, last);
  }
  // Amounts that make kTorqueChange of the torque.
  static VectorXd UsualAmounts(const MatrixXd& directions) {
    return directions.colwise().norm().transpose().unaryExpr(
        [](double size) { return size > 0 ? kTorqueChange / size : 1; });
  }

  void TellFactors(const std::vector<std::string>& names,
                   const std::pair<double, double>& stddev,
                   NamedHypothesis* named) const;
  MatrixXd AllFriction(const std::vector<JointTerm>& terms,
                       const VectorXd& level) const;
  void AddAllFriction(const std::vector<JointTerm>& terms);
  void AddFriction(int joint);
  void AddTerm(int joint, JointTerm term, ChangedPart part);
  void AddScale(int joint);
  void AddAllScales();
  void AddMass(int link);

 private:
  void Keep(NamedHypothesis named) {
    constexpr int kParts = 10;  // one family for each part of each joint
    named.change.family =
        kParts * (named.joint + 1) + static_cast<int>(named.part);
    named.change.motion = MotionOf(named.part, named.joint);
    all_->push_back(std::move(named));
  }

  const Robot& robot_;
  const LogSeries& series_;
  const MatrixXd& levels_;
  const VectorXd level_;  // in the first log
  std::vector<NamedHypothesis>* all_;
  VectorXd nominal_;
};

// Says of numbers that they are factors on something of all joints, one for
// each name, then joint by joint what each one's own differs by. `stddev`: of
// these and of those. Told are the joints' mean and each joint's.
void Maker::TellFactors(const std::vector<std::string>& names,
                        const std::pair<double, double>& stddev,
                        NamedHypothesis* named) const {
  const int joints = robot_.num_joints();
  const auto size = static_cast<Eigen::Index>(names.size());
  const Eigen::Index numbers = size * (joints + 1);
  named->change.prior = VectorXd::Constant(numbers, stddev.second);
  named->change.prior.head(size).setConstant(stddev.first);
  named->told = MatrixXd::Zero(numbers, numbers);
  named->names = names;
  for (Eigen::Index t = 0; t < size; ++t) {
    named->told(t, t) = 1;
    named->told.row(t)
        .segment(size + t * joints, joints)
        .setConstant(1. / joints);
    for (int j = 0; j < joints; ++j) {
      const Eigen::Index at = size + t * joints + j;
      named->told(at, t) = named->told(at, at) = 1;
      named->names.push_back(names[t] + " of " + robot_.links[j].joint.name);
    }
  }
  named->units.assign(named->names.size(), "1");
}

// Factors on these terms of all joints' friction, one each, then joint by joint
// (parameters x terms (1 + joints)).
MatrixXd Maker::AllFriction(const std::vector<JointTerm>& terms,
                            const VectorXd& level) const {
  const int joints = robot_.num_joints();
  const auto size = static_cast<Eigen::Index>(terms.size());
  MatrixXd directions = MatrixXd::Zero(level.size(), size * (joints + 1));
  for (Eigen::Index t = 0; t < size; ++t) {
    directions.col(t) = FrictionDirection(series_, level, terms[t]);
    for (int j = 0; j < joints; ++j) {
      const int k = series_.TermIndex(j, terms[t]);
      if (k < 0) continue;
      directions(k, size + t * joints + j) = directions(k, t);
    }
  }
  return directions;
}

// All joints' friction of these terms by about one factor each: a number for
// the factor, and one for each joint by which its own differs.
void Maker::AddAllFriction(const std::vector<JointTerm>& terms) {
  NamedHypothesis named{ChangedPart::kAllFriction, -1, {}, {}, {}, {}, {}};
  const auto size = static_cast<Eigen::Index>(terms.size());
  for (const auto level : levels_.colwise()) {
    named.directions.push_back(AllFriction(terms, level));
  }
  std::vector<std::string> names;
  for (Eigen::Index t = 0; t < size; ++t) {
    if ((named.directions[0].col(t).array() > 0).count() < 2) return;
    names.emplace_back(JointTermName(terms[t]));
    named.change.scatter.push_back(static_cast<int>(level_.size()) +
                                   (terms[t] == JointTerm::kViscous ? 0 : 1));
  }
  TellFactors(names, {kFrictionChange, kOwnFactor}, &named);
  named.change.share = kShareOfAllFriction / 3;
  Add(std::move(named));
}

void Maker::AddFriction(int joint) {
  const auto add = [&](const std::vector<JointTerm>& terms) {
    NamedHypothesis named{ChangedPart::kFriction, joint, {}, {}, {}, {}, {}};
    MatrixXd directions = MatrixXd::Zero(
        series_.pooled.size(), static_cast<Eigen::Index>(terms.size()));
    named.change.prior.resize(directions.cols());
    for (Eigen::Index c = 0; c < directions.cols(); ++c) {
      const JointTerm term = terms[c];
      const int k = series_.TermIndex(joint, term);
      if (k < 0) return;
      directions(k, c) = 1 / series_.torque[k];
      named.names.emplace_back(JointTermName(term));
      named.units.push_back(
          JointTermUnit(term, robot_.links[joint].joint.type));
      named.change.prior[c] = std::max(kFrictionChange * std::abs(level_[k]),
                                       kNewFriction * series_.torque[k]);
    }
    named.change.share = kShareOfFriction / 3 / robot_.num_joints();
    Add(named, directions);
  };
  add({JointTerm::kViscous});
  add({JointTerm::kCoulomb});
  add({JointTerm::kViscous, JointTerm::kCoulomb});
}

void Maker::AddTerm(int joint, JointTerm term, ChangedPart part) {
  NamedHypothesis named{part, joint, {}, {JointTermName(term)}, {}, {}, {}};
  named.units.push_back(JointTermUnit(term, robot_.links[joint].joint.type));
  const MatrixXd direction = Direction(
      [&](Robot* robot) { *TermOf(term, &robot->links[joint].joint) += 1; });
  named.change.prior = UsualAmounts(direction);
  named.change.share = kShareOfOther / 4 / robot_.num_joints();
  Add(named, direction);
}

void Maker::AddScale(int joint) {
  NamedHypothesis named{
      ChangedPart::kTorqueScale, joint, {}, {"scale"}, {"1"}, {}, {}};
  named.change.columns = series_.by_scale[joint];
  named.change.prior = VectorXd::Constant(1, kTorqueChange);
  named.change.share = kShareOfOther / 4 / robot_.num_joints();
  named.change.scatter = series_.parameters.row_columns(joint);
  named.told = MatrixXd::Identity(1, 1);
  AddOfTorque(std::move(named));
}

// All joints' torques by about one factor.
void Maker::AddAllScales() {
  const int joints = robot_.num_joints();
  if (joints < 2) return;
  NamedHypothesis named{ChangedPart::kAllScales, -1, {}, {}, {}, {}, {}};
  for (size_t l = 0; l < series_.equations.size(); ++l) {
    MatrixXd columns(series_.equations[l].root.rows(), 1 + joints);
    for (int j = 0; j < joints; ++j) {
      columns.col(1 + j) = series_.by_scale[j][l];
    }
    columns.col(0) = columns.rightCols(joints).rowwise().sum();
    named.change.columns.push_back(columns);
  }
  TellFactors({"scale"}, {kAllScalesChange, kOwnScale}, &named);
  named.change.share = kShareOfOther / 4;
  for (int k = 0; k < level_.size(); ++k) named.change.scatter.push_back(k);
  AddOfTorque(std::move(named));
}

void Maker::AddMass(int link) {
  const bool last = link + 1 == robot_.num_joints();
  const double others = std::max(1, robot_.num_joints() - 1);
  const bool alone = robot_.num_joints() == 1;
  for (const int count : {4, 10}) {  // mass and moments; and inertia
    NamedHypothesis named{ChangedPart::kMass, link, {}, {}, {}, {}, {}};
    MatrixXd directions(series_.pooled.size(), count);
    for (int c = 0; c < count; ++c) {
      named.names.emplace_back(InertialName(c));
      named.units.emplace_back(InertialUnit(c));
      directions.col(c) = Direction([&](Robot* robot) {
        InertialParameters& body = robot->links[link].inertial;
        Vector10d V = body.ToVector();
        V[c] += 1;
        body = InertialParameters::FromVector(V);
      });
    }
    named.change.prior = UsualAmounts(directions);
    named.change.share = kShareOfMass / 2 *
                         (alone  ? 1
                          : last ? .5
                                 : .5 / others);
    Add(named, directions);
  }
}

}  // namespace

const char* ChangedPartName(ChangedPart part) {
  switch (part) {
    case ChangedPart::kAllFriction:
      return "all_friction";
    case ChangedPart::kFriction:
      return "friction";
    case ChangedPart::kOffset:
      return "offset";
    case ChangedPart::kArmature:
      return JointTermName(JointTerm::kArmature);
    case ChangedPart::kTorqueScale:
      return "torque_scale";
    case ChangedPart::kAllScales:
      return "all_torque_scales";
    case ChangedPart::kMass:
      return "mass";
  }
  return "";
}

std::vector<NamedHypothesis> MakeHypotheses(const Robot& robot,
                                            const LogSeries& series,
                                            const MatrixXd& levels) {
  std::vector<NamedHypothesis> all;
  Maker maker(robot, series, levels, &all);
  maker.AddAllFriction({JointTerm::kViscous});
  maker.AddAllFriction({JointTerm::kCoulomb});
  maker.AddAllFriction({JointTerm::kViscous, JointTerm::kCoulomb});
  for (int j = 0; j < robot.num_joints(); ++j) {
    maker.AddFriction(j);
    maker.AddTerm(j, JointTerm::kOffset, ChangedPart::kOffset);
    maker.AddTerm(j, JointTerm::kArmature, ChangedPart::kArmature);
    maker.AddScale(j);
    maker.AddMass(j);
  }
  maker.AddAllScales();
  return all;
}

}  // namespace armcal
