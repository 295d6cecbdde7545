#include "model/log_files/log_row.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "model/text/decimal_number.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

// A number too small for a double is 0; from_chars reports it like one too
// large.
bool IsTiny(std::string_view number) {
  return number.find("e-") != number.npos || number.find("E-") != number.npos;
}

bool ParseSample(std::string_view field, double* value) {
  const std::string_view number = TrimNumber(field);
  const char* end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, *value);
  if (number.empty() || stop != end) return false;
  if (error == std::errc::result_out_of_range && IsTiny(number)) {
    *value = 0;
    return true;
  }
  return error == std::errc() && std::isfinite(*value);
}

}  // namespace

LogRow::LogRow(const std::string& file, const LogColumns& columns,
               int time_column)
    : file_(file), columns_(columns), separator_(columns.separator()) {
  if (time_column < 0) return;
  Step time;
  time.column.index = time_column;
  time.skip = time_column;
  steps_.push_back(time);
}

int LogRow::Use(const std::vector<LogColumn>& columns) {
  const int first = width_;
  for (const LogColumn& column : columns) {
    steps_.push_back({column, 0, width_++});
  }
  std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) {
    return a.column.index < b.column.index;
  });
  int at = 0;
  for (Step& step : steps_) {
    step.skip = step.column.index - at;
    at = step.column.index;
  }
  return first;
}

// Steps over `count` separators; null where the row ends before.
const char* LogRow::Skip(const char* p, const char* end, int count) const {
  for (; count > 0; --count) {
    p = EndOfField(p, end);
    if (p == end) return nullptr;
    ++p;
  }
  return p;
}

const char* LogRow::EndOfField(const char* p, const char* end) const {
  if (p == end || *p == separator_) return p;
  const void* stop = std::memchr(p, separator_, end - p);
  return stop ? static_cast<const char*>(stop) : end;
}

// Returns the end of the field at p; null where it is not a finite number.
const char* LogRow::ParseField(const char* p, const char* end,
                               double* value) const {
  const auto [stop, error] = ParseDecimalNumber(p, end, value);
  const bool whole = stop == end || *stop == separator_;
  if (whole && error == std::errc() && std::isfinite(*value)) return stop;
  end = EndOfField(p, end);
  return ParseSample(std::string_view(p, end - p), value) ? end : nullptr;
}

bool LogRow::Parse(std::string_view line, double* values,
                   std::string_view* time) const {
  const char* p = line.data();
  const char* const end = p + line.size();
  for (const Step& step : steps_) {
    p = Skip(p, end, step.skip);
    if (!p) return false;
    const char* const begin = p;
    if (step.place == kTime) {
      p = EndOfField(p, end);
      *time = std::string_view(begin, p - begin);
      continue;
    }
    double value;
    p = ParseField(p, end, &value);
    if (!p) return false;
    values[step.place] = value * step.column.scale;
  }
  const int last = steps_.back().column.index;
  return last + 1 + std::count(p, end, separator_) == columns_.size();
}

void LogRow::Refuse(std::string_view line, long row, bool cut) const {
  const std::string place = "row " + std::to_string(row);
  const auto fields = 1 + std::count(line.begin(), line.end(), separator_);
  if (fields != columns_.size()) {
    std::string expected =
        "expected " + std::to_string(columns_.size()) + " as in the header";
    if (cut) expected += "; the file ends inside this row, delete it";
    throw InputError(
        file_, place,
        std::to_string(fields) + (fields > 1 ? " fields" : " field"), expected);
  }
  const char* p = line.data();
  const char* const end = p + line.size();
  for (const Step& step : steps_) {
    p = Skip(p, end, step.skip);
    const std::string_view field(p, EndOfField(p, end) - p);
    double value;
    if (step.place == kTime || ParseSample(field, &value)) continue;
    throw InputError(file_,
                     place + ", column " + columns_.name(step.column.index),
                     OneLine(Trim(field)), ExpectedNumber(field));
  }
  throw InputError(file_, place, OneLine(line), "not a row of numbers");
}

std::string ExpectedNumber(std::string_view field) {
  if (Trim(field).empty()) return "the field is empty, expected a number";
  if (field.find(',') != field.npos) {
    return "expected a finite number with a decimal point, not a comma";
  }
  return "expected a finite number";
}

std::string_view TrimNumber(std::string_view field) {
  field = Trim(field);
  const bool plus = field.size() > 1 && field[0] == '+' && field[1] != '-';
  return plus ? field.substr(1) : field;
}

}  // namespace armcal
