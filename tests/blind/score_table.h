#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace armcal {

// A table of a score: rows by their names, columns in the order in which they
// first come. A cell counts hits or collects values.
class ScoreTable {
 public:
  explicit ScoreTable(const std::string& title) : title_(title) {}

  void Count(const std::string& row, const std::string& column, bool hit);
  void Measure(const std::string& row, const std::string& column, double value);

  struct Cell {
    int hits = 0, count = 0;
    std::vector<double> values;  // of Measure
  };
  // An empty cell where nothing was counted.
  Cell At(const std::string& row, const std::string& column) const;

  // Counts as "28/32 87.5 % [71.0, 96.5]" (Clopper-Pearson), values as their
  // median and 10 % and 90 % quantiles; a line per cell.
  std::string Text() const;
  nlohmann::json Json() const;

 private:
  Cell& Make(const std::string& row, const std::string& column);

  std::string title_;
  std::set<std::string> rows_;
  std::vector<std::string> columns_;
  std::map<std::pair<std::string, std::string>, Cell> cells_;
};

// How far probabilities are from how often they were right.
class Reliability {
 public:
  void Add(double probability, bool right);
  // Mean of |mean probability - share right| over ten equal bins, by count
  // (Naeini, Cooper and Hauskrecht 2015).
  double ExpectedCalibrationError() const;
  std::string Text() const;
  nlohmann::json Json() const;

 private:
  static constexpr int kBins = 10;
  struct Bin {
    double sum = 0;  // of probabilities
    int right = 0, count = 0;
  };
  Bin bins_[kBins];
};

}  // namespace armcal
