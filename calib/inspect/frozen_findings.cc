#include "calib/inspect/frozen_findings.h"

#include <algorithm>
#include <string>

#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

std::string EvidenceOfRun(const FrozenChannel& run) {
  const std::string rows =
      Format("%d rows of one number; ", run.end - run.begin);
  if (run.jump != 0) {
    return rows + Format(
                      "then it goes %.3g rad or m in one row, more "
                      "than five times what its motion has",
                      run.jump);
  }
  return rows +
         Format(run.is_position
                    ? "its torque goes on, %.3g rms from what holds it at "
                      "rest, where a fit of the arm leaves %.3g elsewhere"
                    : "a fit of the arm to all other rows leaves %.3g rms "
                      "there and %.3g elsewhere",
                run.gap, run.usual) +
         Format(" (%.0f nats)", run.nats);
}

}  // namespace

bool IsOf(const FrozenChannel& run, const InspectionFinding& finding) {
  const std::string signal = run.is_position ? "position" : "torque";
  return finding.joint == run.joint &&
         finding.sentence.compare(0, signal.size(), signal) == 0;
}

std::vector<InspectionFinding> FrozenFindings(
    const Robot& robot, const Eigen::VectorXd& t,
    const std::vector<FrozenChannel>& frozen) {
  std::vector<InspectionFinding> findings;
  for (const FrozenChannel& run : frozen) {
    const std::string& joint = robot.links[run.joint].joint.name;
    InspectionFinding finding{
        "stuck",
        std::string("the ") + (run.is_position ? "position" : "torque") +
            " of " + joint +
            Format(" is stuck at %.6g from %.6g s to %.6g s", run.value,
                   t[run.begin], t[run.end - 1]),
        EvidenceOfRun(run),
        OptionName("fix") + " writes the log without these rows", run.joint};
    finding.leads = true;
    findings.push_back(finding);
  }
  return findings;
}

std::vector<RowRange> RowsOf(const std::vector<FrozenChannel>& frozen) {
  std::vector<RowRange> rows;
  for (const FrozenChannel& run : frozen) rows.push_back({run.begin, run.end});
  return rows;
}

Log WithoutFrozenRows(const Log& log,
                      const std::vector<FrozenChannel>& frozen) {
  return WithoutRows(log, RowsOf(frozen));
}

void DropVelocitiesOfFrozen(const std::vector<FrozenChannel>& frozen,
                            const std::vector<InspectionFinding>& others,
                            std::vector<InspectionFinding>* findings) {
  for (const FrozenChannel& run : frozen) {
    const auto is_of = [&](const InspectionFinding& f) {
      return run.is_position && f.joint == run.joint && f.finding == "velocity";
    };
    if (std::any_of(others.begin(), others.end(), is_of)) continue;
    DropFindings(is_of, findings);
  }
}

}  // namespace armcal
