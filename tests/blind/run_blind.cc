// run_blind --armcal=FILE --logs=DIR --labels=DIR --answers=DIR
//
// Diagnoses cases of the blind bench in processes that cannot see what they
// hide (tests/blind/README.md). Run again, it goes on where it stopped.

#include <gflags/gflags.h>

#include <cstdio>

#include "tests/blind/blind_program.h"
#include "tests/blind/blind_runner.h"

DEFINE_string(armcal, "build/armcal", "the program with `diagnose`");
DEFINE_string(logs, "blind/logs", "the cases");
DEFINE_string(labels, "blind/labels", "what to hide from it; may be absent");
DEFINE_string(answers, "blind/answers", "CASE/diagnosis.json and run.json");
DEFINE_string(validation, "",
              "folder with CASE/validation.csv to use instead of the cases'; "
              "empty: their own");
DEFINE_bool(forward, true, "the diagnoser's");
DEFINE_int32(jobs, 2, "cases at a time");
DEFINE_double(timeout, 300, "s, of a case");

namespace armcal {
namespace {

int Main() {
  std::vector<std::string> flags;
  if (!FLAGS_forward) flags.push_back("--forward=false");
  const BlindRunSummary summary =
      RunBlindCases({FLAGS_armcal, FLAGS_logs, FLAGS_labels, FLAGS_answers,
                     FLAGS_validation, flags, FLAGS_jobs, FLAGS_timeout});
  std::printf("answered %d, failed %d, run before %d\n", summary.answered,
              summary.failed, summary.kept);
  return summary.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  return armcal::RunBlindProgram("run_blind", &armcal::Main, argc, argv);
}
