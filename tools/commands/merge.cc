#include "tools/commands/merge.h"

#include <gflags/gflags.h>

#include "calib/merge.h"
#include "tools/command_report.h"
#include "tools/input_flags.h"
#include "tools/log_flags.h"
#include "tools/report/report_page.h"

DEFINE_string(factors, "",
              "`FILES` factor files of armcal reduce A[,B..], or folders of "
              "them");

namespace armcal {
namespace {

CommandOutcome RunMerge(const CommandInput& input) {
  const Robot robot = RobotFromFlags(input);
  const std::string factors = input.flags.Text("factors");
  if (factors.empty()) throw UsageError("--factors=FILES is needed");
  MergeOptions options;
  options.source = RobotSourceFromFlags(input);
  options.source.sha256 = HashDocument(RobotFileFromFlags(input)).sha256;
  options.progress = input.progress;
  return OutcomeOf(input, robot, Merge(robot, SplitAtCommas(factors), options),
                   robot.notes);
}

}  // namespace

Command MergeCommand() {
  return {"merge",
          "factor files to a calibration, and what the units of one robot "
          "have in common, differ in and drift by",
          {{"robot and factors", {"robot", "factors"}}, ChainFlags()},
          {"armcal merge --robot=arm.urdf --factors=mon.factor,tue.factor",
           "armcal merge --robot=arm.urdf --factors=factors --out=merged"},
          &RunMerge};
}

}  // namespace armcal
