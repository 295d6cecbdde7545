#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/blind/case_score.h"
#include "tests/blind/score_table.h"

namespace armcal {

// The tables that issue 5 asks for, filled case by case. What each line counts
// is told in tests/blind/README.md.
class BlindScore {
 public:
  void Add(const CaseScore& score);

  std::string Text() const;
  // Every table, the cases with a fault, and those whose effects could not have
  // the planned size.
  nlohmann::json Json() const;

  // For tests.
  const ScoreTable& none() const { return none_; }
  const ScoreTable& one() const { return one_; }
  const ScoreTable& by_effect() const { return by_effect_; }
  const ScoreTable& two() const { return two_; }
  const ScoreTable& outside() const { return outside_; }
  const ScoreTable& sizes() const { return sizes_; }
  const ScoreTable& removed_share() const { return removed_share_; }
  const Reliability& reliability() const { return reliability_; }

 private:
  void AddNone(const CaseScore& score);
  void AddOne(const CaseScore& score);
  void AddOneRow(const CaseScore& score, const std::string& row);
  void AddTwo(const CaseScore& score);
  void AddOutside(const CaseScore& score);
  void AddSizes(const CaseScore& score);
  void AddRemovedShare(const CaseScore& score);
  void AddInterval(const BlindLabel& label, const BlindAnswer& answer);
  void AddFault(const CaseScore& score);
  void AddSizeLimits(const CaseScore& score);
  std::string ListsText() const;

  ScoreTable none_{"No effect"};
  ScoreTable one_{"One effect"};
  ScoreTable by_effect_{"One effect, ENR >= 0.32 and 0.17-0.32, by effect"};
  ScoreTable two_{"Two effects"};
  ScoreTable outside_{"Out of catalogue"};
  ScoreTable sizes_{"Relative error of sizes named rightly, ENR >= 0.32"};
  ScoreTable removed_share_{
      "Shrink, ENR >= 0.32 and removable gap >= 0.3 floors"};
  Reliability reliability_;
  // Of cases with one effect and ENR >= 0.32: truth, then answer.
  std::map<std::string, std::map<std::string, int>> confusion_;
  nlohmann::json faults_ = nlohmann::json::array();
  nlohmann::json size_limits_ = nlohmann::json::array();
};

}  // namespace armcal
