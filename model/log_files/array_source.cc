#include "model/log_files/array_source.h"

#include <algorithm>

#include "model/log_files/columns/log_signal.h"
#include "model/log_files/columns/wrench_columns.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

bool IsOneOf(const std::string& name,
             std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The signal that an array of this name holds; null for others.
const SignalNames* FindSignal(const std::string& name) {
  if (name == "torque") return &NamesOf(Signal::kEffort);
  if (name == "dof_pos") return &NamesOf(Signal::kPosition);
  if (name == "dof_vel") return &NamesOf(Signal::kVelocity);
  if (name == "des_dof_pos") return &NamesOf(Signal::kReference);
  for (const Signal signal : kSignals) {
    const SignalNames& names = NamesOf(signal);
    if (name == names.number_prefix || name == names.path_part) return &names;
  }
  return nullptr;
}

bool IsColumn(const LogArray& array) {
  return array.kind != 0 &&
         array.name.find_first_of("\"\r\n") == std::string::npos;
}

// The longest of the arrays that `is_meant` picks by name; 0 where none is.
template <typename Pick>
long RowsOf(const std::vector<LogArray>& arrays, const Pick& is_meant) {
  long rows = 0;
  for (const LogArray& array : arrays) {
    if (IsColumn(array) && is_meant(array.name)) {
      rows = std::max(rows, array.rows);
    }
  }
  return rows;
}

bool IsPosition(const std::string& name) {
  return FindSignal(name) == &NamesOf(Signal::kPosition) || name == "q1";
}

}  // namespace

ArraySource::ArraySource(const std::string& path, std::vector<LogArray> arrays)
    : path_(path) {
  for (const LogArray& array : arrays) {
    if (array.texts.empty() ||
        !IsOneOf(array.name, {"joint_names", "names", "name"})) {
      continue;
    }
    joints_ = array.texts;
  }
  rows_ = RowsOf(arrays, [](const std::string& n) { return IsTimeName(n); });
  if (rows_ == 0) rows_ = RowsOf(arrays, IsPosition);
  for (const LogArray& array : arrays) {
    if (!array.name.empty() && !array.why_none.empty()) {
      NoteUnused(array, array.why_none);
    }
  }
  if (rows_ == 0) {
    std::vector<std::string> names;
    for (const LogArray& array : arrays) names.push_back(array.name);
    throw InputError(path, "", OneLine(JoinNames(names)),
                     "has no array of times: expected t, time or timestamp" +
                         (about_.empty() ? "" : "; " + about_));
  }
  for (LogArray& array : arrays) {
    if (IsColumn(array)) Add(std::move(array));
  }
}

void ArraySource::Add(LogArray array) {
  if (array.rows == rows_) {
    AddToHeader(array);
    arrays_.push_back(std::move(array));
  } else if (FindSignal(array.name) != nullptr) {
    throw InputError(path_, "array " + array.name,
                     std::to_string(array.rows) + " rows",
                     "expected " + std::to_string(rows_) +
                         ", as many as the array of times (t, time or "
                         "timestamp) has");
  } else {
    NoteUnused(array, "of " + std::to_string(array.rows) + " rows, not " +
                          std::to_string(rows_));
  }
}

void ArraySource::NoteUnused(const LogArray& array, const std::string& why) {
  constexpr size_t kMostText = 300;
  if (about_.size() > kMostText) return;
  about_ += about_.empty() ? "not used: " : ", ";
  about_ += OneLine(array.name) + " (" + why + ")";
}

void ArraySource::AddToHeader(const LogArray& array) {
  const SignalNames* const signal = FindSignal(array.name);
  const bool named = static_cast<long>(joints_.size()) == array.columns;
  const bool wrench =
      array.name == kWrenchArray && array.columns == kWrenchColumns;
  for (long k = 0; k < array.columns; ++k) {
    std::string column = array.name;
    if (wrench) {
      column = kWrenchNames[k];
    } else if (signal != nullptr) {
      column = named
                   ? joints_[k] + "/" + std::string(signal->path_part)
                   : std::string(signal->number_prefix) + std::to_string(k + 1);
    } else if (array.columns > 1) {
      column += std::to_string(k + 1);
    }
    header_ += (header_.empty() ? "\"" : ",\"") + column + "\"";
  }
}

bool ArraySource::NextLine(std::string_view* line) {
  if (row_ > rows_) return false;
  if (row_ == 0) {
    *line = header_;
  } else {
    line_.clear();
    for (const LogArray& array : arrays_) {
      for (long k = 0; k < array.columns; ++k) {
        if (!line_.empty()) line_ += ',';
        array.AppendNumber(row_ - 1, k, &line_);
      }
    }
    *line = line_;
  }
  ++row_;
  return true;
}

}  // namespace armcal
