#include "calib/inspect/position_unit.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/median.h"
#include "model/robot/axis_rotation.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

bool IsOfVelocity(const InspectionFinding& finding) {
  return finding.finding == "velocity";
}

// Of which joints findings say so.
std::vector<bool> WrongVelocities(
    const Robot& robot, const std::vector<InspectionFinding>& findings) {
  std::vector<bool> wrong(robot.num_joints(), false);
  for (const InspectionFinding& f : findings) {
    if (IsOfVelocity(f)) wrong[f.joint] = true;
  }
  return wrong;
}

// Of which joints velocities are not the slopes of positions in these units.
std::vector<bool> WrongVelocities(const Robot& robot, Log log,
                                  const StampFigures& stamps,
                                  const PositionUnits& units) {
  for (int j = 0; j < robot.num_joints(); ++j) {
    log.q.col(j) *= units.Of(robot.links[j].joint);
  }
  return WrongVelocities(robot, AuditChannels(robot, log, stamps));
}

// What a hundredth of the values is beyond, in size.
double Most(const VectorXd& values) {
  const VectorXd size = values.cwiseAbs();
  return Quantile({size.begin(), size.end()}, .99);
}

// A share of a limit, rad or m or their rates; 0 where the file has none.
double ShareOf(double limit, double value) {
  return limit > 0 && std::isfinite(limit) ? value / limit : 0;
}

// How many times as far from zero as its limits a joint goes.
double BeyondPositions(const Joint& joint, const VectorXd& q) {
  return ShareOf(std::max(std::abs(joint.lower), std::abs(joint.upper)),
                 Most(q));
}

class Hints {
 public:
  Hints(const Robot& robot, const Log& log, const StampFigures& stamps,
        const std::vector<InspectionFinding>& findings,
        const Eigen::MatrixXd& qd)
      : robot_(robot),
        log_(log),
        stamps_(stamps),
        wrong_as_logged_(WrongVelocities(robot, findings)),
        qd_(qd) {}

  PositionUnitHint Of(const PositionUnits& units) const {
    PositionUnitHint hint = OfLimits(units);
    if (VelocitiesTell(units))
      hint.evidence = "the recorded velocities are the positions' slopes then";
    return hint;
  }

 private:
  bool Concerns(const PositionUnits& units, int j) const {
    return units.Of(robot_.links[j].joint) != 1;
  }
  bool AnyConcerned(const PositionUnits& units,
                    const std::vector<bool>& joints) const {
    for (int j = 0; j < robot_.num_joints(); ++j) {
      if (joints[j] && Concerns(units, j)) return true;
    }
    return false;
  }

  bool VelocitiesTell(const PositionUnits& units) const {
    return AnyConcerned(units, wrong_as_logged_) &&
           !AnyConcerned(units, WrongVelocities(robot_, log_, stamps_, units));
  }

  // A file's velocity limit may be a placeholder below the real one; where a
  // joint can be is drawn in its geometry, so positions say more.
  PositionUnitHint OfLimits(const PositionUnits& units) const {
    PositionUnitHint hint;
    bool within = true;  // of all joints concerned, in that unit
    for (int j = 0; j < robot_.num_joints(); ++j) {
      if (!Concerns(units, j)) continue;
      const Joint& joint = robot_.links[j].joint;
      const double unit = units.Of(joint), least = 1 / std::sqrt(unit);
      const double positions = BeyondPositions(joint, log_.q.col(j));
      const double beyond =
          std::max(positions, ShareOf(joint.velocity, Most(qd_.col(j))));
      hint.out_of_reach = hint.out_of_reach || positions > least;
      within = within && positions * unit <= 1;
      if (!(beyond > least) || !hint.evidence.empty()) continue;
      hint.evidence = Format("as logged %s is at %.3g times its limits",
                             joint.name.c_str(), beyond);
    }
    hint.out_of_reach = hint.out_of_reach && within;
    return hint;
  }

  const Robot& robot_;
  const Log& log_;
  const StampFigures& stamps_;
  const std::vector<bool> wrong_as_logged_;
  const Eigen::MatrixXd& qd_;
};

}  // namespace

double PositionUnits::Of(const Joint& joint) const {
  if (IsRotational(joint.type)) return degrees ? kDegree : 1;
  return millimetres ? 1e-3 : 1;
}

PositionUnitHints HintsOfPositionUnit(
    const Robot& robot, const Log& log, const StampFigures& stamps,
    const std::vector<InspectionFinding>& findings, const Eigen::MatrixXd& qd) {
  const Hints hints(robot, log, stamps, findings, qd);
  return {hints.Of({true, false}), hints.Of({false, true})};
}

std::vector<bool> PutPositionUnitFirst(
    const Robot& robot, const Log& log, const StampFigures& stamps,
    const PositionUnits& units, std::vector<InspectionFinding>* findings) {
  const std::vector<bool> wrong = WrongVelocities(robot, log, stamps, units);
  std::vector<bool> follows(robot.num_joints(), false);
  std::vector<InspectionFinding> first, others;
  for (const InspectionFinding& f : *findings) {
    if (f.finding == "position_unit") {
      first.push_back(f);
    } else if (IsOfVelocity(f) && !wrong[f.joint]) {
      follows[f.joint] = true;
    } else {
      others.push_back(f);
    }
  }
  first.insert(first.end(), others.begin(), others.end());
  *findings = first;
  return follows;
}

}  // namespace armcal
