#include "calib/inspect/jump_findings.h"

#include <algorithm>
#include <string>

#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// "2 times, first at 3.21 s"
std::string HowOften(size_t times, double first) {
  return times == 1 ? Format("at %.4g s", first)
                    : Format("%zu times, first at %.4g s", times, first);
}

std::string FixWrites(const char* what) {
  return OptionName("fix") + " writes the log " + what;
}

InspectionFinding OfSpikes(const std::string& joint, int j,
                           const Eigen::VectorXd& t,
                           const std::vector<PositionSpike>& spikes) {
  long rows = 0;
  for (const auto& spike : spikes) rows += spike.end - spike.begin;
  return {"position_spike", "the position of " + joint + " has wrong samples",
          Format("%ld rows that it leaves its motion for, ", rows) +
              HowOften(spikes.size(), t[spikes[0].begin]) +
              Format(" by %.3g", spikes[0].size),
          FixWrites("with these on the line between the rows around"), j};
}

bool AreWithin(const PositionSpike& spike,
               const std::vector<PositionSpike>& wrong_rows) {
  return std::any_of(wrong_rows.begin(), wrong_rows.end(),
                     [&](const PositionSpike& row) {
                       return row.begin <= spike.begin && spike.end <= row.end;
                     });
}

InspectionFinding OfWrongRows(const Eigen::VectorXd& t, const LogJumps& jumps) {
  constexpr size_t kTold = 4;
  long rows = 0;
  std::string when;
  for (size_t k = 0; k < jumps.wrong_rows.size(); ++k) {
    const PositionSpike& wrong = jumps.wrong_rows[k];
    rows += wrong.end - wrong.begin;
    if (k > kTold) continue;
    when += k == 0 ? " at " : ", ";
    when += k == kTold ? ".." : Format("%.6g", t[wrong.begin]);
  }
  return {"wrong_rows", "rows of the log are not of its motion",
          Format("%ld row%s at which positions of several joints are elsewhere "
                 "at once,",
                 rows, rows == 1 ? "" : "s") +
              when + " s",
          FixWrites("with these on the line between the rows around")};
}

InspectionFinding OfWraps(const std::string& joint, int j,
                          const Eigen::VectorXd& t,
                          const std::vector<PositionJumps::Step>& wraps) {
  return {"position_wrap", "the position of " + joint + " wraps round",
          "by a whole turn, " + HowOften(wraps.size(), t[wraps[0].row]),
          FixWrites("with these turns taken out"), j};
}

InspectionFinding OfSteps(const std::string& joint, int j,
                          const Eigen::VectorXd& t,
                          const std::vector<PositionJumps::Step>& steps) {
  InspectionFinding finding{
      "position_jump", "the position of " + joint + " jumps",
      Format("by %.3g in one row, ", steps[0].size) +
          HowOften(steps.size(), t[steps[0].row]),
      "its zero is another one after that: cut the log there (" +
          OptionName("crop") + ")",
      j};
  finding.leads = true;
  return finding;
}

}  // namespace

std::vector<InspectionFinding> JumpFindings(const Robot& robot,
                                            const Eigen::VectorXd& t,
                                            const LogJumps& jumps,
                                            bool clock_is_wrong) {
  std::vector<InspectionFinding> findings;
  const std::vector<int>& missing = jumps.missing_time;
  if (!missing.empty() && !clock_is_wrong) {
    findings.push_back({"missing_time",
                        "time is missing that the stamps do not show",
                        "several joints jump in one row, " +
                            HowOften(missing.size(), t[missing[0]]),
                        "cut the log there (" + OptionName("crop") + ")"});
  }
  if (!jumps.wrong_rows.empty()) findings.push_back(OfWrongRows(t, jumps));
  for (size_t k = 0; k < jumps.joints.size(); ++k) {
    const int j = static_cast<int>(k);
    const std::string& joint = robot.links[k].joint.name;
    const PositionJumps& own = jumps.joints[k];
    std::vector<PositionSpike> alone;  // in which no other joint has one
    for (const PositionSpike& spike : own.spikes) {
      if (!AreWithin(spike, jumps.wrong_rows)) alone.push_back(spike);
    }
    if (!alone.empty()) findings.push_back(OfSpikes(joint, j, t, alone));
    if (!own.wraps.empty()) findings.push_back(OfWraps(joint, j, t, own.wraps));
    if (!own.steps.empty()) findings.push_back(OfSteps(joint, j, t, own.steps));
  }
  return findings;
}

}  // namespace armcal
