// diagnose_with_thresholds NAME=VALUE[,..] diagnose --flags
//
// armcal diagnose with other thresholds, to see what each decides
// (sensitivity.py). diagnose_with_thresholds --list: all of them, as JSON.

#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "calib/diagnose/data/thresholds.h"
#include "tools/flag_parser.h"
#include "tools/output_folder.h"
#include "tools/program/command_list.h"

namespace armcal {
namespace {

const char* KindName(ThresholdInfo::Kind kind) {
  switch (kind) {
    case ThresholdInfo::Kind::kLaw:
      return "law";
    case ThresholdInfo::Kind::kDefinition:
      return "definition";
    case ThresholdInfo::Kind::kTuned:
      break;
  }
  return "tuned";
}

nlohmann::json ThresholdsJson() {
  nlohmann::json all = nlohmann::json::array();
  for (const ThresholdInfo& threshold : ListThresholds()) {
    all.push_back({{"name", threshold.name},
                   {"value", Limits().*threshold.value},
                   {"unit", threshold.unit},
                   {"meaning", threshold.meaning},
                   {"kind", KindName(threshold.kind)},
                   {"source", threshold.source}});
  }
  return all;
}

int Main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "--list") {
    std::cout << ThresholdsJson().dump(1) << "\n";
    return 0;
  }
  SetThresholds(first);
  const Command& command = *FindCommand("diagnose");
  CommandInput input;
  input.flags = ParseFlags(command, argc - 2, argv + 2).values;
  CommandOutcome outcome = command.run(input);
  OutputFolder::WriteTogether(&outcome.folders);
  return outcome.code();
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  try {
    return armcal::Main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
