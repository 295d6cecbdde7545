#include "tests/blind/case_score.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

// The joint that an effect of two joints acts on as well; 0: none is told.
int NeighbourIn(const std::vector<NamedValue>& values) {
  for (const NamedValue& value : values) {
    if (value.name == "neighbour") return static_cast<int>(value.value + .5);
  }
  return 0;
}

// A bearing between two joints' shafts, told from its other side: ratio r and
// torque F here are 1 / r and r F there, exactly.
bool IsOtherSide(const NamedEffect& named, int neighbour,
                 const BlindLabel::Effect& truth) {
  return named.effect == "coupled_friction" &&
         truth.placed.effect == named.effect &&
         named.joint_index == NeighbourIn(truth.values) &&
         (neighbour == 0 || neighbour == truth.placed.joint_index);
}

Match MatchOf(const std::string& arm, const NamedEffect& named, int neighbour,
              const BlindLabel::Effect& truth, const Equivalents& equivalents) {
  if (named == truth.placed || IsOtherSide(named, neighbour, truth)) {
    return Match::kRight;
  }
  return equivalents.Hold(arm, named, truth.placed) ? Match::kEquivalent
                                                    : Match::kWrong;
}

}  // namespace

CaseScore::CaseScore(const BlindLabel& label, const BlindAnswer& answer,
                     const Equivalents& equivalents)
    : label_(label), answer_(answer) {
  for (const BlindAnswer::Effect& named : answer.effects) {
    std::vector<Match> row;
    for (const BlindLabel::Effect& truth : label.effects) {
      row.push_back(MatchOf(label.arm, named.placed,
                            NeighbourIn(named.estimates), truth, equivalents));
    }
    matches_.push_back(row.empty() ? Match::kWrong
                                   : *std::max_element(row.begin(), row.end()));
    pairs_.push_back(row);
  }
  for (const NamedEffect& candidate : answer.candidates) {
    candidates_hold_ |= !label.effects.empty() &&
                        MatchOf(label.arm, candidate, 0, label.effects[0],
                                equivalents) != Match::kWrong;
  }
}

bool CaseScore::detects() const {
  return claims() || answer_.verdict == "unknown" ||
         answer_.verdict == "partly_explained";
}

bool CaseScore::alarms() const {
  return detects() || answer_.verdict == "explained";
}

bool CaseScore::top_allows_truth() const {
  if (top() != Match::kWrong) return true;
  if (!claims() || label_.effects.empty()) return false;
  const auto& own = answer_.effects[0].equivalent;
  return std::count(own.begin(), own.end(), label_.effects[0].placed) > 0;
}

bool CaseScore::top_joint() const {
  if (!claims() || label_.effects.empty()) return false;
  return top() != Match::kWrong || answer_.effects[0].placed.joint_index ==
                                       label_.effects[0].placed.joint_index;
}

bool CaseScore::FindsEffect(size_t k) const {
  return std::any_of(pairs_.begin(), pairs_.end(),
                     [k](const auto& row) { return row[k] != Match::kWrong; });
}

bool CaseScore::finds_all() const {
  for (size_t k = 0; k < label_.effects.size(); ++k) {
    if (!FindsEffect(k)) return false;
  }
  return true;
}

bool CaseScore::exact() const {
  return finds_all() && answer_.effects.size() == label_.effects.size();
}

bool CaseScore::names_wrongly() const {
  for (size_t i = 0; i < matches_.size(); ++i) {
    if (answer_.effects[i].probability >= kConfident &&
        matches_[i] == Match::kWrong) {
      return true;
    }
  }
  return false;
}

std::optional<double> CaseScore::SizeError(size_t k) const {
  const BlindLabel::Effect& truth = label_.effects[k];
  if (truth.values.empty()) return std::nullopt;
  const NamedValue& size = truth.values[0];
  for (const BlindAnswer::Effect& named : answer_.effects) {
    if (!(named.placed == truth.placed)) continue;
    for (const NamedValue& estimate : named.estimates) {
      if (estimate.name != size.name || estimate.unit != size.unit) continue;
      return std::abs(estimate.value / size.value - 1);
    }
  }
  return std::nullopt;
}

std::string CaseScore::Fault() const {
  if (!answered()) return "no answer";
  if (label_.effects.empty()) return alarms() ? "false alarm" : "";
  if (!label_.effects[0].in_catalogue) {
    return names_wrongly() ? "confident wrong name" : "";
  }
  if (!detects()) return "missed";
  if (!claims()) return "not named";
  if (label_.effects.size() > 1) {
    if (exact()) return "";
    if (finds_all()) return "more than there is";
    return top() == Match::kWrong ? "wrong" : "one of two";
  }
  if (top() == Match::kWrong)
    return top_joint() ? "wrong effect" : "wrong joint";
  return exact() ? "" : "more than there is";
}

}  // namespace armcal
