#include "tests/blind/score_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "calib/numerics/median.h"
#include "tests/blind/binomial_interval.h"

namespace armcal {
namespace {

using nlohmann::json;

double Mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / values.size();
}

std::string CellText(const ScoreTable::Cell& cell) {
  char text[120];
  if (!cell.values.empty()) {
    std::snprintf(text, sizeof text,
                  "n %zu  median %.4g  q10 %.4g  q90 %.4g  mean %.4g",
                  cell.values.size(), Quantile(cell.values, .5),
                  Quantile(cell.values, .1), Quantile(cell.values, .9),
                  Mean(cell.values));
    return text;
  }
  const BinomialInterval interval = ClopperPearson(cell.hits, cell.count);
  std::snprintf(text, sizeof text, "%d/%d  %.1f %%  [%.1f, %.1f]", cell.hits,
                cell.count, 100. * cell.hits / cell.count, 100 * interval.low,
                100 * interval.high);
  return text;
}

json CellJson(const ScoreTable::Cell& cell) {
  if (!cell.values.empty()) {
    return {{"count", cell.values.size()},
            {"median", Quantile(cell.values, .5)},
            {"q10", Quantile(cell.values, .1)},
            {"q90", Quantile(cell.values, .9)},
            {"mean", Mean(cell.values)}};
  }
  const BinomialInterval interval = ClopperPearson(cell.hits, cell.count);
  return {{"hits", cell.hits},
          {"count", cell.count},
          {"ci95", {interval.low, interval.high}}};
}

}  // namespace

ScoreTable::Cell& ScoreTable::Make(const std::string& row,
                                   const std::string& column) {
  rows_.insert(row);
  if (!std::count(columns_.begin(), columns_.end(), column)) {
    columns_.push_back(column);
  }
  return cells_[{row, column}];
}

void ScoreTable::Count(const std::string& row, const std::string& column,
                       bool hit) {
  Cell& cell = Make(row, column);
  cell.hits += hit;
  ++cell.count;
}

void ScoreTable::Measure(const std::string& row, const std::string& column,
                         double value) {
  Make(row, column).values.push_back(value);
}

ScoreTable::Cell ScoreTable::At(const std::string& row,
                                const std::string& column) const {
  const auto found = cells_.find({row, column});
  return found == cells_.end() ? Cell() : found->second;
}

std::string ScoreTable::Text() const {
  std::string text = "## " + title_ + "\n";
  for (const std::string& row : rows_) {
    for (const std::string& column : columns_) {
      const auto found = cells_.find({row, column});
      if (found == cells_.end()) continue;
      char line[300];
      std::snprintf(line, sizeof line, "%-28s %-34s %s\n", row.c_str(),
                    column.c_str(), CellText(found->second).c_str());
      text += line;
    }
  }
  return text;
}

json ScoreTable::Json() const {
  json table = json::object();
  for (const auto& [key, cell] : cells_) {
    table[key.first][key.second] = CellJson(cell);
  }
  return table;
}

void Reliability::Add(double probability, bool right) {
  const int k = static_cast<int>(probability * kBins);
  Bin& bin = bins_[std::clamp(k, 0, kBins - 1)];
  bin.sum += probability;
  bin.right += right;
  ++bin.count;
}

double Reliability::ExpectedCalibrationError() const {
  double error = 0;
  int count = 0;
  for (const Bin& bin : bins_) {
    error += std::abs(bin.sum - bin.right);
    count += bin.count;
  }
  return count == 0 ? 0 : error / count;
}

std::string Reliability::Text() const {
  std::string text = "## Probabilities of claimed effects\n";
  char line[160];
  for (int k = 0; k < kBins; ++k) {
    const Bin& bin = bins_[k];
    if (bin.count == 0) continue;
    std::snprintf(line, sizeof line, "%.1f-%.1f  n %d  mean %.3f  right %.3f\n",
                  .1 * k, .1 * (k + 1), bin.count, bin.sum / bin.count,
                  1. * bin.right / bin.count);
    text += line;
  }
  std::snprintf(line, sizeof line, "expected calibration error %.4f\n",
                ExpectedCalibrationError());
  return text + line;
}

json Reliability::Json() const {
  json bins = json::array();
  for (int k = 0; k < kBins; ++k) {
    const Bin& bin = bins_[k];
    if (bin.count == 0) continue;
    bins.push_back({{"from", .1 * k},
                    {"count", bin.count},
                    {"mean", bin.sum / bin.count},
                    {"right", 1. * bin.right / bin.count}});
  }
  return {{"bins", bins},
          {"expected_calibration_error", ExpectedCalibrationError()}};
}

}  // namespace armcal
