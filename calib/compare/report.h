#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "calib/compare/agreement.h"
#include "calib/compare/held_out_residuals.h"

namespace armcal {

struct ComparedPair {
  int a, b;
  Agreement agreement;
};

// What several results say of one robot.
struct Comparison {
  double errors;  // how often noise alone makes them disagree
  std::vector<ComparedResult> results;
  std::vector<ComparedPair> pairs;  // of each two
  std::optional<HeldOutResiduals> held_out;
  std::vector<std::string> notes;  // sentences

  bool agrees() const;
};

// For a terminal: the results, by letters; values that differ, or the most
// different ones; the verdict.
std::string ToText(const Comparison& comparison);
// A sentence.
std::string BriefText(const Comparison& comparison);
// comparison.json (docs/compare.md).
nlohmann::json ToJson(const Comparison& comparison);

}  // namespace armcal
