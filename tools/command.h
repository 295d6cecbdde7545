#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calib/logs/log_set.h"
#include "model/log_files/log_source.h"
#include "model/robot/robot.h"
#include "model/text/document.h"
#include "tools/console.h"
#include "tools/flag_values.h"
#include "tools/output_folder.h"
#include "tools/spooled_pipes.h"
#include "tools/usage_error.h"

namespace armcal {

struct TracedModel;  // calib/logs/torque_trace.h

enum ExitCode {
  kExitOk = 0,
  kExitNegative = 1,  // ran, but the verdict is negative
  kExitUsage = 2,
  kExitBadInput = 3,
  kExitInternal = 4,
};

// Flags that stand together in help, under a heading.
struct FlagGroup {
  std::string heading;
  std::vector<std::string> flags;
  bool usual = true;  // others are only named by --help; --helpfull has them
};

// What a command is given.
struct CommandInput {
  FlagValues flags;
  std::optional<Robot> robot;  // instead of that in the file of --robot
  // What that robot was read from, instead of the file of --robot.
  std::optional<Document> robot_file;
  // Logs in memory, by the names that flags have for them.
  std::map<std::string, LogSource> logs;
  // What came out of those that are pipes.
  std::shared_ptr<SpooledPipes> pipes = std::make_shared<SpooledPipes>();
  Progress progress;    // a fraction below 0: nobody knows
  bool report = false;  // make report.html even without --out

  bool WantsReport() const { return report || !flags.Text("out").empty(); }

  void Begin(const std::string& stage) const {
    if (progress) progress(stage, -1);
  }
};

// What a command has to say. Who runs it prints and writes.
struct CommandOutcome {
  Output output;
  std::vector<OutputFolder> folders;  // result files, all of them or none
  std::string brief;  // a sentence of the text, where there is one
  // Of calibrate and diagnose, where there is one: calibrated, corrected.
  std::optional<Robot> robot;
  // Of calibrate: what predicts torques.
  std::shared_ptr<const TracedModel> model;

  ExitCode code() const { return output.positive ? kExitOk : kExitNegative; }
};

// A command of armcal: flags -> library call -> outcome. What help, the manual
// page and the shells' completion say of it follows from this and from the
// flags' definitions, whose descriptions hold the value's form in backquotes:
// "robot `FILE`: ...".
struct Command {
  const char* name;
  const char* summary;             // one line
  std::vector<FlagGroup> groups;   // in the order of help; no others are taken
  std::vector<const char*> usage;  // command lines as they are typed
  CommandOutcome (*run)(const CommandInput& input);
  // The flag that words without dashes are values of; null: no word is taken.
  const char* words_of = nullptr;

  std::vector<std::string> FlagNames() const;
};

}  // namespace armcal
