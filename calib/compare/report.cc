#include "calib/compare/report.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/json_figures.h"
#include "calib/numerics/readable_sum.h"
#include "model/text/format.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using nlohmann::json;

std::string Letter(int k) { return std::string(1, static_cast<char>('A' + k)); }

// Those that differ first, then by standard deviations.
std::vector<ValueDifference> Sorted(std::vector<ValueDifference> values) {
  const auto size = [](const ValueDifference& d) {
    return std::isnan(d.deviations) ? 0 : std::abs(d.deviations);
  };
  std::stable_sort(values.begin(), values.end(),
                   [&](const ValueDifference& a, const ValueDifference& b) {
                     if (a.differs != b.differs) return a.differs;
                     return size(a) > size(b);
                   });
  return values;
}

std::string Table(const ComparedPair& pair) {
  constexpr size_t kFewest = 5;  // shown where none or few differ
  constexpr size_t kMost = 15;
  const std::vector<ValueDifference> sorted = Sorted(pair.agreement.values);
  if (sorted.empty()) return "";
  const auto differing = static_cast<size_t>(
      std::count_if(sorted.begin(), sorted.end(),
                    [](const ValueDifference& d) { return d.differs; }));
  const size_t shown =
      std::min({sorted.size(), kMost, std::max(kFewest, differing)});
  std::string text = Format(
      "\n  %-30s %-22s %-22s %s\n", "", Letter(pair.a).c_str(),
      Letter(pair.b).c_str(),
      (Letter(pair.b) + " - " + Letter(pair.a) + ", deviations").c_str());
  for (size_t k = 0; k < shown; ++k) {
    const ValueDifference& d = sorted[k];
    text += Format("  %-30s %-22s %-22s ", ReadableSum(d.name).c_str(),
                   WithStddev(d.a, d.a_stddev).c_str(),
                   WithStddev(d.b, d.b_stddev).c_str());
    text += std::isnan(d.deviations)
                ? std::string(d.differs ? "differ" : "same")
                : Format("%8.1f%s", d.deviations, d.differs ? "  differ" : "");
    text += "\n";
  }
  if (shown < sorted.size()) {
    text += Format("  and %zu that differ less\n", sorted.size() - shown);
  }
  return text;
}

std::string PairText(const ComparedPair& pair) {
  const Agreement& agreement = pair.agreement;
  std::string text = Table(pair);
  if (agreement.degrees > 0) {
    text += Format("together: squares of deviations %.3g in the mean, p %s\n",
                   agreement.MeanSquare(),
                   ProbabilityText(agreement.probability).c_str());
  }
  if (!agreement.only_a.empty() || !agreement.only_b.empty()) {
    text += Format("known to one alone, not compared: %zu of %s, %zu of %s\n",
                   agreement.only_a.size(), Letter(pair.a).c_str(),
                   agreement.only_b.size(), Letter(pair.b).c_str());
  }
  return text;
}

// The first of them: the table has all values that differ.
std::string Reasons(const ComparedPair& pair) {
  constexpr size_t kMost = 5;
  const std::vector<std::string>& all = pair.agreement.disagreements;
  std::string text;
  for (size_t k = 0; k < std::min(kMost, all.size()); ++k) {
    text += "  " + all[k] + "\n";
  }
  if (all.size() > kMost) {
    text += Format("  and %zu more\n", all.size() - kMost);
  }
  return text;
}

std::string HeldOutText(const HeldOutResiduals& held_out) {
  std::string text = Format("\ntorque left on the log, low-passed at %.3g Hz\n",
                            held_out.bandwidth_hz);
  for (size_t k = 0; k < held_out.robots.size(); ++k) {
    text += Format("  %s  %.3g %%\n", Letter(static_cast<int>(k)).c_str(),
                   held_out.robots[k].stacked_percent);
  }
  for (const ResidualRatio& ratio : held_out.ratios) {
    text += Format("  %s leaves %.3g (%.3g to %.3g) times what %s leaves\n",
                   Letter(ratio.b).c_str(), ratio.value, ratio.low, ratio.high,
                   Letter(ratio.a).c_str());
  }
  return text;
}

json LogsJson(const ComparedResult& result) {
  json logs = json::array();
  for (const ComparedLog& log : result.logs) {
    logs.push_back(
        {{"file", log.file}, {"begin_s", log.begin}, {"end_s", log.end}});
  }
  return logs;
}

json ValueJson(const ValueDifference& d) {
  return {{"name", d.name},
          {"unit", d.unit},
          {"a", JsonNumber(d.a)},
          {"b", JsonNumber(d.b)},
          {"a_stddev", JsonNumber(d.a_stddev)},
          {"b_stddev", JsonNumber(d.b_stddev)},
          {"deviations", JsonNumber(d.deviations)},
          {"differs", d.differs}};
}

json PairJson(const ComparedPair& pair) {
  json values = json::array();
  for (const ValueDifference& d : pair.agreement.values) {
    values.push_back(ValueJson(d));
  }
  const Agreement& agreement = pair.agreement;
  return {{"a", pair.a},
          {"b", pair.b},
          {"agrees", agreement.disagreements.empty()},
          {"disagreements", agreement.disagreements},
          {"sum_of_squares", JsonNumber(agreement.sum_of_squares)},
          {"degrees", agreement.degrees},
          {"probability", JsonNumber(agreement.probability)},
          {"values", values},
          {"only_a", agreement.only_a},
          {"only_b", agreement.only_b}};
}

json HeldOutJson(const HeldOutResiduals& held_out) {
  json out = {{"bandwidth_hz", held_out.bandwidth_hz},
              {"results", json::array()},
              {"ratios", json::array()}};
  for (const HeldOutResidual& residual : held_out.robots) {
    json percent = json::array();
    for (const double p : residual.percent) percent.push_back(JsonNumber(p));
    out["results"].push_back(
        {{"stacked_percent", JsonNumber(residual.stacked_percent)},
         {"percent", percent}});
  }
  for (const ResidualRatio& ratio : held_out.ratios) {
    out["ratios"].push_back(
        {{"a", ratio.a},
         {"b", ratio.b},
         {"ratio", JsonNumber(ratio.value)},
         {"ci95", {JsonNumber(ratio.low), JsonNumber(ratio.high)}}});
  }
  return out;
}

}  // namespace

bool Comparison::agrees() const {
  return std::all_of(pairs.begin(), pairs.end(), [](const ComparedPair& pair) {
    return pair.agreement.disagreements.empty();
  });
}

std::string BriefText(const Comparison& comparison) {
  if (comparison.agrees()) {
    return comparison.pairs.size() == 1 ? "the two agree within noise"
                                        : "all agree within noise";
  }
  std::vector<std::string> apart;
  for (const ComparedPair& pair : comparison.pairs) {
    if (pair.agreement.disagreements.empty()) continue;
    apart.push_back(Letter(pair.a) + " and " + Letter(pair.b));
  }
  return JoinNames(apart) + " disagree beyond noise";
}

std::string ToText(const Comparison& comparison) {
  std::string text;
  for (size_t k = 0; k < comparison.results.size(); ++k) {
    const ComparedResult& result = comparison.results[k];
    text +=
        Format("%s  %s: %s of %s, %s\n", Letter(static_cast<int>(k)).c_str(),
               result.name.c_str(), KindName(result.kind), result.robot.c_str(),
               result.verdict.c_str());
  }
  for (const ComparedPair& pair : comparison.pairs) text += PairText(pair);
  if (comparison.held_out) text += HeldOutText(*comparison.held_out);
  text += "\n" + BriefText(comparison) + "\n";
  for (const ComparedPair& pair : comparison.pairs) text += Reasons(pair);
  return text;
}

json ToJson(const Comparison& comparison) {
  json results = json::array(), pairs = json::array();
  for (const ComparedResult& result : comparison.results) {
    results.push_back({{"file", result.name},
                       {"kind", KindName(result.kind)},
                       {"robot", result.robot},
                       {"verdict", result.verdict},
                       {"logs", LogsJson(result)}});
  }
  for (const ComparedPair& pair : comparison.pairs) {
    pairs.push_back(PairJson(pair));
  }
  json out = {{"format", "armcal comparison 1"},
              {"agrees", comparison.agrees()},
              {"sentence", BriefText(comparison)},
              {"errors", comparison.errors},
              {"results", results},
              {"pairs", pairs},
              {"notes", comparison.notes},
              {"held_out", nullptr}};
  if (comparison.held_out) out["held_out"] = HeldOutJson(*comparison.held_out);
  return out;
}

}  // namespace armcal
