#include "calib/inspect/position_unit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calib/numerics/median.h"
#include "model/robot/axis_rotation.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Whether a joint's velocity is the slope of its position in these units.
bool IsRightIn(const PositionUnits& units, const Joint& joint, int column,
               VelocityFit fit) {
  fit.factor /= units.Of(joint, column);
  return fit.right();
}

// Whether it says of a velocity what these units explain.
bool FollowsFrom(const PositionUnits& units, const Robot& robot, const Log& log,
                 const InspectionFinding& finding) {
  if (finding.finding != "velocity") return false;
  const auto fit = FitVelocity(log, finding.joint);
  return fit && IsRightIn(units, robot.links[finding.joint].joint,
                          finding.joint, *fit);
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
  Hints(const Robot& robot, const Log& log, const Eigen::MatrixXd& qd)
      : robot_(robot), log_(log), qd_(qd) {
    for (int j = 0; j < robot.num_joints(); ++j) {
      velocity_.push_back(FitVelocity(log, j));
    }
  }

  PositionUnitHint Of(const PositionUnits& units) const {
    PositionUnitHint hint = OfLimits(units);
    hint.by_velocities = VelocitiesTell(units);
    if (hint.by_velocities)
      hint.evidence = "the recorded velocities are the positions' slopes then";
    return hint;
  }

 private:
  bool Concerns(const PositionUnits& units, int j) const {
    return units.Of(robot_.links[j].joint, j) != 1;
  }
  // All velocities that tell are right in these units, and one is not as
  // logged.
  bool VelocitiesTell(const PositionUnits& units) const {
    bool any = false;
    for (int j = 0; j < robot_.num_joints(); ++j) {
      if (!Concerns(units, j) || !velocity_[j]) continue;
      if (!IsRightIn(units, robot_.links[j].joint, j, *velocity_[j]))
        return false;
      any |= !velocity_[j]->right();
    }
    return any;
  }

  // A joint whose velocity is not its position's slope, while another's is:
  // what is wrong with it is not of all joints.
  bool IsAlone(const PositionUnits& units, int j) const {
    if (!velocity_[j] || velocity_[j]->right()) return false;
    for (int k = 0; k < robot_.num_joints(); ++k) {
      if (Concerns(units, k) && velocity_[k] && velocity_[k]->right())
        return true;
    }
    return false;
  }

  // A file's velocity limit may be a placeholder below the real one; where a
  // joint can be is drawn in its geometry, so positions say more.
  PositionUnitHint OfLimits(const PositionUnits& units) const {
    PositionUnitHint hint;
    bool within = true;  // of all joints concerned, in that unit
    for (int j = 0; j < robot_.num_joints(); ++j) {
      if (!Concerns(units, j) || IsAlone(units, j)) continue;
      const Joint& joint = robot_.links[j].joint;
      const double unit = units.Of(joint, j), least = 1 / std::sqrt(unit);
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
  std::vector<std::optional<VelocityFit>> velocity_;
  const Eigen::MatrixXd& qd_;
};

}  // namespace

double PositionUnits::Of(const Joint& joint, int from) const {
  if (column >= 0 && column != from) return 1;
  if (IsRotational(joint.type)) return degrees ? kDegree : 1;
  return millimetres ? 1e-3 : 1;
}

PositionUnitHints HintsOfPositionUnit(const Robot& robot, const Log& log,
                                      const Eigen::MatrixXd& qd) {
  const Hints hints(robot, log, qd);
  return {hints.Of({true, false}), hints.Of({false, true})};
}

std::vector<bool> PutPositionUnitFirst(
    const Robot& robot, const Log& log, const PositionUnits& units,
    std::vector<InspectionFinding>* findings) {
  std::vector<bool> follows(robot.num_joints(), false);
  std::vector<InspectionFinding> first, others;
  for (const InspectionFinding& f : *findings) {
    if (f.finding == "position_unit") {
      first.push_back(f);
    } else if (FollowsFrom(units, robot, log, f)) {
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
