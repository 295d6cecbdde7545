#include "calib/inspect/position_unit.h"

#include "model/robot/axis_rotation.h"

namespace armcal {
namespace {

bool IsOfVelocity(const InspectionFinding& finding) {
  return finding.finding == "velocity";
}

// Of which joints velocities are not the slopes of positions in rad either.
std::vector<bool> StillWrong(const Robot& robot, Log log,
                             const StampFigures& stamps) {
  for (int j = 0; j < robot.num_joints(); ++j) {
    if (IsRotational(robot.links[j].joint.type)) log.q.col(j) *= kDegree;
  }
  std::vector<bool> wrong(robot.num_joints(), false);
  for (const InspectionFinding& f : AuditChannels(robot, log, stamps)) {
    if (IsOfVelocity(f)) wrong[f.joint] = true;
  }
  return wrong;
}

}  // namespace

std::vector<bool> PutPositionUnitFirst(
    const Robot& robot, const Log& log, const StampFigures& stamps,
    std::vector<InspectionFinding>* findings) {
  const std::vector<bool> wrong = StillWrong(robot, log, stamps);
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
