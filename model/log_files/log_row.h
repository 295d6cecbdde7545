#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/log_files/columns/log_columns.h"

namespace armcal {

// Takes the used fields out of the rows of a log. The others are stepped over,
// but counted: a row must have as many fields as the header.
class LogRow {
 public:
  // A negative `time_column`: the table has no time.
  LogRow(const std::string& file, const LogColumns& columns, int time_column);

  // Has these columns parsed too; returns the place of the first among the
  // values. All calls come before the first Parse().
  int Use(const std::vector<LogColumn>& columns);
  // Values per row.
  int width() const { return width_; }

  // Writes width() numbers in SI units to `values` and the time as it stands in
  // the row to *time; false where the row is not as it should be.
  bool Parse(std::string_view line, double* values,
             std::string_view* time) const;
  // Throws InputError that says why Parse() returned false. `cut`: the file
  // ended inside the row.
  [[noreturn]] void Refuse(std::string_view line, long row, bool cut) const;

 private:
  static constexpr int kTime = -1;
  struct Step {
    LogColumn column;
    int skip = 0;  // separators between the used column before and this one
    int place = kTime;
  };

  const char* Skip(const char* p, const char* end, int count) const;
  const char* EndOfField(const char* p, const char* end) const;
  const char* ParseField(const char* p, const char* end, double* value) const;

  std::string file_;
  LogColumns columns_;
  char separator_;
  std::vector<Step> steps_;  // in the order of the file
  int width_ = 0;
};

// What a field that is not a finite number should have been.
std::string ExpectedNumber(std::string_view field);
// A number without the spaces around it and the plus sign before it, neither
// of which std::from_chars takes.
std::string_view TrimNumber(std::string_view field);

}  // namespace armcal
