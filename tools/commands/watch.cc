#include "tools/commands/watch.h"

#include <gflags/gflags.h>

#include <optional>

#include "calib/watch.h"
#include "tools/command_report.h"
#include "tools/input_flags.h"
#include "tools/interruption.h"
#include "tools/log_flags.h"
#include "tools/watch_page.h"

DEFINE_bool(follow, false,
            "the log is being written: wait for more rows (a pipe, --log=-, "
            "is followed to its end without it)");
DEFINE_double(idle, 10,
              "`S` after which a followed log without new rows has ended; 0: "
              "Ctrl-C ends it");
DEFINE_double(learn, 30,
              "`S` of motion that tell what is normal, at first; longer where "
              "the robot does many things");
DEFINE_double(memory, 120,
              "`S` over which friction and the like may wander unnoticed");
DEFINE_double(false_alarms, .1, "`NUMBER` an hour, of all tests together");
DEFINE_int32(serve, -1,
             "`PORT` of a page on this machine that shows it; 0: any that is "
             "free");

namespace armcal {
namespace {

WatchOptions OptionsOf(const CommandInput& input, const Robot& robot) {
  const FlagValues& flags = input.flags;
  WatchOptions options;
  options.calibration = flags.Text("calibration");
  if (options.calibration.empty()) {
    throw UsageError("--calibration is needed: the result of armcal calibrate");
  }
  options.reading = LogOptionsFromFlags(flags, robot);
  options.bandwidth_hz = BandwidthFromFlags(flags);
  options.follow = flags.Switch("follow");
  options.idle_s = flags.Number("idle");
  options.learn_s = flags.Number("learn");
  options.memory_s = flags.Number("memory");
  options.false_alarms_per_hour = flags.Number("false_alarms");
  return options;
}

// The one log; a pipe has no name.
LogSource LogOf(const CommandInput& input) {
  const std::string name = input.flags.Text("log");
  if (name.empty())
    throw UsageError("--log is needed: a file, or - for a pipe");
  if (name == "-") return name;
  const std::vector<std::string> names = LogsFromFlags(input);
  if (names.size() > 1) {
    throw UsageError("--log: expected one log to watch, found " +
                     std::to_string(names.size()));
  }
  // What is still being written is not waited for.
  const bool is_file = input.logs.count(names[0]) == 0;
  if (is_file && input.flags.Switch("follow")) return names[0];
  return SourceOf(input, names[0]);
}

// Lines are out before the next sample is read.
void PrintEvent(const FlagValues& flags, const WatchEvent& event) {
  if (flags.Switch("json")) {
    PrintText(ToJson(event).dump() + "\n");
  } else if (!flags.Switch("quiet")) {
    PrintText(ToText(event) + "\n");
  }
}

CommandOutcome RunWatch(const CommandInput& input) {
  const LogSource log = LogOf(input);
  const Robot robot = RobotFromFlags(input);
  WatchOptions options = OptionsOf(input, robot);
  const AskedToEnd asked_to_end;
  options.stop = &AskedToEnd::Asked;
  std::optional<WatchPage> page;
  const int port = input.flags.Whole("serve");
  if (port > 65535) {
    throw UsageError("--serve: found " + std::to_string(port) +
                     ", expected a port, 0 to 65535");
  }
  if (port >= 0) {
    page.emplace(robot, port);
    PrintError("watching at http://127.0.0.1:" + std::to_string(page->port()));
    options.on_state = [&page](const WatchState& state) { page->Show(state); };
  }
  options.on_event = [&](const WatchEvent& event) {
    PrintEvent(input.flags, event);
    if (page) page->Add(event);
  };
  const Summary summary = Watch(robot, log, options);
  CommandOutcome outcome = OutcomeOf(input, robot, summary, robot.notes);
  std::vector<std::string> files = {options.calibration};
  if (log.name != "-") files.push_back(log.name);
  AddProvenance(input, "watch", files, &outcome.folders[0]);
  return outcome;
}

}  // namespace

Command WatchCommand() {
  return {"watch",
          "tells when payload, friction or contact changes on a running robot",
          {{"robot and log", {"robot", "calibration", "log", "follow", "idle"}},
           {"tests", {"learn", "memory", "false_alarms", "bandwidth"}},
           {"page", {"serve"}},
           TorqueFlags(),
           ChainFlags()},
          {"armcal watch --robot=arm.urdf --calibration=result "
           "--log=growing.csv --follow",
           "recorder | armcal watch --robot=arm.urdf --calibration=result "
           "--log=- --json --serve=8080"},
          &RunWatch};
}

}  // namespace armcal
