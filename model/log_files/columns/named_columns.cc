#include "model/log_files/columns/named_columns.h"

#include <cmath>
#include <string_view>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

double ScaleOf(const std::string& file, const std::string& column,
               std::string_view text, ColumnUnit unit) {
  const auto refuse = [&](const char* expected) {
    throw InputError(file, "row 1, column " + column, std::string(text),
                     expected);
  };
  if (text.empty()) return 1;
  if (unit == ColumnUnit::kNone) refuse("expected no unit");
  if (unit == ColumnUnit::kAngle) {
    if (text == "deg") return M_PI / 180;
    if (text != "rad") refuse("expected the unit rad or deg");
    return 1;
  }
  if (text == "mm") return 1e-3;
  if (text != "m") refuse("expected the unit m or mm");
  return 1;
}

// Index -1 where there is none.
LogColumn FindOne(const std::string& file, const LogColumns& columns,
                  const std::string& name, ColumnUnit unit) {
  LogColumn found{-1, 1};
  for (int k = 0; k < columns.size(); ++k) {
    std::string_view text;
    if (Trim(SplitUnit(columns.name(k), &text)) != name) continue;
    if (columns.IsOfAJoint(k)) continue;
    if (found.index >= 0) {
      throw InputError(file, "row 1", name, "the column is there twice");
    }
    found = {k, ScaleOf(file, columns.name(k), text, unit)};
  }
  return found;
}

}  // namespace

std::vector<LogColumn> FindNamed(const std::string& file,
                                 const LogColumns& columns,
                                 const std::vector<std::string>& names,
                                 ColumnUnit unit) {
  std::vector<LogColumn> found;
  std::string missing;
  for (const std::string& name : names) {
    const LogColumn column = FindOne(file, columns, name, unit);
    if (column.index >= 0) {
      found.push_back(column);
    } else {
      missing += (missing.empty() ? "" : ", ") + name;
    }
  }
  if (found.empty() || found.size() == names.size()) return found;
  throw InputError(file, "row 1", "", "the column " + missing + " is missing");
}

}  // namespace armcal
