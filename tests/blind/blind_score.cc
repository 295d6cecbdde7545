#include "tests/blind/blind_score.h"

#include <algorithm>
#include <cmath>

#include "tests/blind/case_plan.h"

namespace armcal {
namespace {

using nlohmann::json;

constexpr double kVisible = .32;   // ENR from which goals are the strict ones
constexpr double kBarely = .17;    // and the lax ones
constexpr double kRemovable = .3;  // of the noise floor

std::string BinName(double enr) {
  const char* const names[] = {"< 0.17", "0.17-0.32", "0.32-1", "1-3", "> 3"};
  return names[EnrBin(enr)];
}

std::string AnswerText(const BlindAnswer& answer) {
  std::string text = answer.verdict.empty() ? "no answer" : answer.verdict;
  for (const BlindAnswer::Effect& effect : answer.effects) {
    char p[16];
    std::snprintf(p, sizeof p, " %.2f", effect.probability);
    text += ", " + effect.placed.Text() + p;
  }
  return text;
}

std::string TruthText(const BlindLabel& label) {
  std::string text;
  for (const BlindLabel::Effect& effect : label.effects) {
    char enr[24];
    std::snprintf(enr, sizeof enr, " ENR %.2f", effect.enr);
    text += (text.empty() ? "" : ", ") + effect.placed.Text() + enr;
  }
  return text.empty() ? "none" : text;
}

}  // namespace

void BlindScore::Add(const CaseScore& score) {
  const BlindLabel& label = score.label();
  for (size_t i = 0; i < score.matches().size(); ++i) {
    reliability_.Add(score.answer().effects[i].probability,
                     score.matches()[i] != Match::kWrong);
  }
  if (label.effects.empty()) {
    AddNone(score);
  } else if (!label.effects[0].in_catalogue) {
    AddOutside(score);
  } else {
    if (label.effects.size() == 1) {
      AddOne(score);
    } else {
      AddTwo(score);
    }
    AddSizes(score);
    AddRemovedShare(score);
  }
  AddFault(score);
  AddSizeLimits(score);
}

void BlindScore::AddNone(const CaseScore& score) {
  const bool rich = score.label().rich();
  std::vector<std::string> rows = {rich ? "rich" : "poor"};
  if (!rich) rows.push_back("poor, " + score.label().excitation);
  for (const std::string& row : rows) {
    none_.Count(row, "false alarm", !score.answered() || score.alarms());
    none_.Count(row, "confident wrong name", score.names_wrongly());
    none_.Count(row, "not_testable", score.answer().verdict == "not_testable");
    none_.Count(row, "no answer", !score.answered());
  }
}

void BlindScore::AddOneRow(const CaseScore& score, const std::string& row) {
  one_.Count(row, "detected", score.detects());
  one_.Count(row, "class and joint", score.top() != Match::kWrong);
  one_.Count(row, "  of these an equivalent",
             score.top() == Match::kEquivalent);
  one_.Count(row, "or by its own equivalents", score.top_allows_truth());
  one_.Count(row, "joint", score.top_joint());
  one_.Count(row, "exactly that", score.exact());
  one_.Count(row, "confident wrong name", score.names_wrongly());
  one_.Count(row, "no answer", !score.answered());
  if (score.answer().candidates.empty()) {
    one_.Count(row, "without candidate set", true);
    return;
  }
  one_.Count(row, "without candidate set", false);
  one_.Count(row, "candidate set holds truth", score.candidates_hold());
  one_.Measure(row, "size of candidate set", score.answer().candidates.size());
}

void BlindScore::AddOne(const CaseScore& score) {
  const BlindLabel::Effect& truth = score.label().effects[0];
  const std::string excitation = score.label().rich() ? "rich " : "poor ";
  AddOneRow(score, excitation + BinName(truth.enr));
  const bool visible = truth.enr >= kVisible;
  if (visible) AddOneRow(score, excitation + ">= 0.32");
  if (truth.enr < kBarely) return;
  AddOneRow(score, visible ? "all >= 0.32" : "all 0.17-0.32");
  by_effect_.Count(truth.placed.effect, visible ? ">= 0.32" : "0.17-0.32",
                   score.top() != Match::kWrong);
  if (!visible) return;
  ++confusion_[truth.placed.effect]
              [score.claims() ? score.answer().effects[0].placed.effect
                              : score.answer().verdict];
}

void BlindScore::AddTwo(const CaseScore& score) {
  const BlindLabel& label = score.label();
  const std::string size =
      label.least_enr() >= kVisible ? "both >= 0.32" : "one < 0.32";
  for (const std::string& row :
       {size, size + (label.rich() ? ", rich" : ", poor")}) {
    two_.Count(row, "detected", score.detects());
    two_.Count(row, "both found", score.finds_all());
    two_.Count(row, "one found", score.FindsEffect(0) || score.FindsEffect(1));
    two_.Count(row, "strongest claim right", score.top() != Match::kWrong);
    two_.Count(row, "exactly these", score.exact());
    two_.Count(row, "confident wrong name", score.names_wrongly());
  }
}

void BlindScore::AddOutside(const CaseScore& score) {
  const BlindLabel::Effect& truth = score.label().effects[0];
  const bool visible = truth.enr >= kVisible;
  std::vector<std::string> rows = {visible ? "all >= 0.32" : "all < 0.32"};
  if (visible) rows.push_back(truth.placed.effect);
  for (const std::string& row : rows) {
    outside_.Count(row, "abstains or equivalent",
                   score.answered() && !score.names_wrongly());
    outside_.Count(row, "confident wrong name", score.names_wrongly());
    outside_.Count(row, "any wrong name",
                   score.claims() && score.top() == Match::kWrong);
    outside_.Count(row, "detected", score.detects());
  }
}

void BlindScore::AddSizes(const CaseScore& score) {
  for (size_t k = 0; k < score.label().effects.size(); ++k) {
    const BlindLabel::Effect& truth = score.label().effects[k];
    if (truth.enr < kVisible) continue;
    const auto error = score.SizeError(k);
    if (score.FindsEffect(k)) {
      sizes_.Count("all", "found, with a size", error.has_value());
      sizes_.Count(truth.placed.effect, "found, with a size",
                   error.has_value());
    }
    if (!error) continue;
    sizes_.Measure("all", "error", *error);
    sizes_.Measure(truth.placed.effect, "error", *error);
  }
}

void BlindScore::AddRemovedShare(const CaseScore& score) {
  const BlindLabel& label = score.label();
  if (label.least_enr() < kVisible || label.removable < kRemovable) return;
  const BlindAnswer::Gap& torque = score.answer().torque;
  const BlindAnswer::Gap& forward = score.answer().forward;
  // Who names nothing removes nothing.
  const double removed = torque.removed_percent.value_or(0);
  removed_share_.Measure("torque", "removed, % (0 where not told)", removed);
  if (torque.removed_percent)
    removed_share_.Measure("torque", "removed, %", removed);
  if (label.oracle_removed_percent) {
    removed_share_.Measure("torque", "share of the oracle's",
                           removed / *label.oracle_removed_percent);
  }
  AddInterval(label, score.answer());
  const auto measure = [this](const char* row, const char* column,
                              const std::optional<double>& value) {
    if (value) removed_share_.Measure(row, column, *value);
  };
  measure("torque", "removed from nominal, %",
          torque.removed_from_nominal_percent);
  measure("forward", "removed, %", forward.removed_percent);
  measure("forward", "removed from nominal, %",
          forward.removed_from_nominal_percent);
}

// An interval may be open above, where the floor could be as large as the gap.
void BlindScore::AddInterval(const BlindLabel& label,
                             const BlindAnswer& answer) {
  const BlindAnswer::Gap& torque = answer.torque;
  if (answer.effects.empty() || !torque.low || !torque.true_removed_percent) {
    return;
  }
  const double removed = *torque.true_removed_percent;
  const auto holds = [&torque](double share) {
    return *torque.low <= share && !(torque.high && *torque.high < share);
  };
  removed_share_.Measure("torque", "truly removed, %", removed);
  removed_share_.Count("torque", "interval holds what is truly removed",
                       holds(removed));
  if (const auto oracle = label.oracle_removed_percent) {
    removed_share_.Measure("torque", "truly removed, share of the oracle's",
                           removed / *oracle);
    removed_share_.Count("torque", "  the oracle's", holds(*oracle));
  }
  removed_share_.Count("torque", "  it is below the interval",
                       *torque.low > removed);
  removed_share_.Count("torque", "interval is open", !torque.high);
}

void BlindScore::AddFault(const CaseScore& score) {
  const std::string fault = score.Fault();
  if (fault.empty()) return;
  const BlindLabel& label = score.label();
  faults_.push_back({{"case", label.name},
                     {"fault", fault},
                     {"stratum", label.stratum},
                     {"arm", label.arm},
                     {"excitation", label.excitation},
                     {"truth", TruthText(label)},
                     {"answer", AnswerText(score.answer())}});
}

void BlindScore::AddSizeLimits(const CaseScore& score) {
  const BlindLabel& label = score.label();
  for (const BlindLabel::Effect& effect : label.effects) {
    if (effect.size_limit.empty()) continue;
    size_limits_.push_back({{"case", label.name},
                            {"arm", label.arm},
                            {"truth", TruthText(label)},
                            {"effect", effect.placed.Text()},
                            {"enr", effect.enr},
                            {"limit", effect.size_limit}});
  }
}

std::string BlindScore::Text() const {
  std::string text;
  for (const ScoreTable* table : {&none_, &one_, &by_effect_, &two_, &outside_,
                                  &sizes_, &removed_share_}) {
    text += table->Text() + "\n";
  }
  text += reliability_.Text() + "\n## Confusion, one effect, ENR >= 0.32\n";
  for (const auto& [truth, answers] : confusion_) {
    text += truth + ":";
    for (const auto& [answer, count] : answers) {
      text += " " + (answer.empty() ? "no answer" : answer) + " " +
              std::to_string(count) + ",";
    }
    text.back() = '\n';
  }
  return text + ListsText();
}

std::string BlindScore::ListsText() const {
  std::string text = "\n## Cases with a fault\n";
  for (const json& fault : faults_) {
    for (const char* key : {"case", "fault", "arm", "excitation"}) {
      text += fault.at(key).get<std::string>() + "; ";
    }
    text += fault.at("truth").get<std::string>() + " -> " +
            fault.at("answer").get<std::string>() + "\n";
  }
  text += "\n## Effects that could not have the planned size\n";
  for (const json& entry : size_limits_) {
    text += entry.at("case").get<std::string>() + "; " +
            entry.at("arm").get<std::string>() + "; " +
            entry.at("truth").get<std::string>() + ": " +
            entry.at("limit").get<std::string>() + "\n";
  }
  return text;
}

json BlindScore::Json() const {
  return {{"none", none_.Json()},
          {"one", one_.Json()},
          {"by_effect", by_effect_.Json()},
          {"two", two_.Json()},
          {"outside", outside_.Json()},
          {"sizes", sizes_.Json()},
          {"shrink", removed_share_.Json()},
          {"probabilities", reliability_.Json()},
          {"confusion", confusion_},
          {"faults", faults_}};
}

}  // namespace armcal
