// score_blind --labels=DIR --answers=DIR [--quiet_answers=DIR] [--logs=DIR]
//   [--equivalents=FILE] [--json=FILE]
//
// Scores the answers of a diagnoser to cases of the blind bench
// (tests/blind/README.md). It alone reads the labels.

#include <gflags/gflags.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "model/text/input_error.h"
#include "tests/blind/blind_program.h"
#include "tests/blind/blind_score.h"
#include "tests/blind/day_changes.h"
#include "tests/blind/true_share.h"

DEFINE_string(labels, "blind/labels", "what the cases hide");
DEFINE_string(answers, "blind/answers", "CASE/diagnosis.json of each");
DEFINE_string(quiet_answers, "",
              "those to the cases with held-out motion without noise, for what "
              "is truly removed; empty: not told");
DEFINE_string(logs, "", "score the cases of this folder; empty: all labels");
DEFINE_string(equivalents, "tests/blind/equivalents.json",
              "effects that cannot be told apart; empty: there are none");
DEFINE_string(json, "", "the same as the printed tables, for programs");

namespace armcal {
namespace {

namespace fs = std::filesystem;

std::set<std::string> Cases() {
  std::set<std::string> cases;
  if (!FLAGS_logs.empty()) {
    for (const auto& entry : fs::directory_iterator(FLAGS_logs)) {
      if (entry.is_directory()) cases.insert(entry.path().filename());
    }
    return cases;
  }
  for (const auto& entry : fs::directory_iterator(FLAGS_labels)) {
    if (entry.path().extension() == ".json") cases.insert(entry.path().stem());
  }
  return cases;
}

int Main() {
  const Equivalents equivalents = FLAGS_equivalents.empty()
                                      ? Equivalents()
                                      : Equivalents(FLAGS_equivalents);
  const std::set<std::string> cases = Cases();
  std::vector<std::pair<BlindLabel, BlindAnswer>> all;
  std::map<std::string, BlindAnswer> untouched;  // by log
  for (const std::string& name : cases) {
    all.emplace_back(
        ReadBlindLabel(fs::path(FLAGS_labels) / (name + ".json")),
        ReadBlindAnswer(fs::path(FLAGS_answers) / name / "diagnosis.json"));
    auto& [label, answer] = all.back();
    if (!FLAGS_quiet_answers.empty()) {
      answer.torque.true_removed_percent = TrueRemovedPercent(
          answer, ReadBlindAnswer(fs::path(FLAGS_quiet_answers) / name /
                                  "diagnosis.json"));
    }
    if (label.effects.empty() && !label.log.empty()) {
      untouched[label.log] = answer;
    }
  }
  BlindScore score;
  for (const auto& [label, answer] : all) {
    const bool compares = !label.effects.empty() && untouched.count(label.log);
    score.Add(CaseScore(
        label,
        compares ? WithoutDayChanges(label, answer, untouched.at(label.log))
                 : answer,
        equivalents));
  }
  std::printf("%zu cases\n\n%s", cases.size(), score.Text().c_str());
  if (!FLAGS_json.empty()) {
    std::ofstream(FLAGS_json) << score.Json().dump(2) << "\n";
  }
  return 0;
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  return armcal::RunBlindProgram("score_blind", &armcal::Main, argc, argv);
}
