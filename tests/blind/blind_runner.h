#pragma once

#include <string>
#include <vector>

namespace armcal {

struct BlindRunOptions {
  std::string diagnoser;  // a program with the command `diagnose`
  std::string logs;       // cases, as write_blind_cases leaves them
  std::string labels;     // what they hide; may be absent
  std::string answers;    // CASE/diagnosis.json and run.json of each
  // Folder with a CASE/validation.csv to use instead of the case's; cases
  // without are left alone. Empty: the case's own.
  std::string validation;
  std::vector<std::string> flags;  // of the diagnoser, beside the case's
  int jobs = 2;
  double timeout_s = 300;  // of a case
};

struct BlindRunSummary {
  int kept = 0;  // that had been run before
  int answered = 0;
  int failed = 0;  // without an answer: it crashed, or took too long
};

// Runs the diagnoser on each case that has not been run, in a folder that holds
// the case's files and tells nothing else, not even its number. As root, the
// labels' folder is closed to others (0700) and the diagnoser runs as nobody;
// otherwise there must be no labels here. Throws InputError where a process
// like the diagnoser's could read a label, and where a case is not as it should
// be.
BlindRunSummary RunBlindCases(const BlindRunOptions& options);

}  // namespace armcal
