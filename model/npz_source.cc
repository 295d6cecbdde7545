#include "model/npz_source.h"

#include <algorithm>

#include "model/input_error.h"
#include "model/input_text.h"
#include "model/log_signal.h"
#include "model/zip_archive.h"

namespace armcal {
namespace {

bool IsOneOf(const std::string& name,
             std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The signal that an array of this name holds; null for others.
const SignalNames* FindSignal(const std::string& name) {
  if (name == "torque") return &NamesOf(Signal::kEffort);
  for (const Signal signal : kSignals) {
    const SignalNames& names = NamesOf(signal);
    if (name == names.number_prefix || name == names.path_part) return &names;
  }
  return nullptr;
}

std::string WithoutExtension(const std::string& name) {
  constexpr std::string_view kExtension = ".npy";
  const size_t stem = name.size() - std::min(name.size(), kExtension.size());
  return name.compare(stem, name.npos, kExtension) == 0 ? name.substr(0, stem)
                                                        : name;
}

}  // namespace

NpzSource::NpzSource(const std::string& path) : path_(path) {
  const ZipArchive archive(path);
  std::vector<std::string> joints;
  std::vector<Array> found;
  for (const ZipEntry& entry : archive.entries()) {
    const std::string name = WithoutExtension(entry.name);
    NpyArray values(path, name, archive.Read(entry));
    if (values.text() && IsOneOf(name, {"joint_names", "names", "name"})) {
      for (long k = 0; k < values.rows(); ++k) joints.push_back(values.Text(k));
    }
    if (!values.numeric() || name.find_first_of("\"\r\n") != name.npos)
      continue;
    if (IsTimeName(name)) rows_ = std::max(rows_, values.rows());
    found.push_back({name, std::move(values)});
  }
  if (std::none_of(found.begin(), found.end(),
                   [](const Array& a) { return IsTimeName(a.name); })) {
    throw InputError(path, "", "",
                     "has no array of times: expected t, time or timestamp");
  }
  for (Array& array : found) {
    const bool signal = FindSignal(array.name) != nullptr;
    if (array.values.rows() != rows_) {
      if (!signal) continue;
      throw InputError(path, "array " + array.name,
                       std::to_string(array.values.rows()) + " rows",
                       "expected " + std::to_string(rows_) +
                           ", as many as the array of times (t, time or "
                           "timestamp) has");
    }
    AddToHeader(array, joints);
    arrays_.push_back(std::move(array));
  }
}

void NpzSource::AddToHeader(const Array& array,
                            const std::vector<std::string>& joints) {
  const SignalNames* const signal = FindSignal(array.name);
  const long columns = array.values.columns();
  const bool named = static_cast<long>(joints.size()) == columns;
  for (long k = 0; k < columns; ++k) {
    std::string column = array.name;
    if (signal != nullptr) {
      column = named
                   ? joints[k] + "/" + std::string(signal->path_part)
                   : std::string(signal->number_prefix) + std::to_string(k + 1);
    } else if (columns > 1) {
      column += std::to_string(k + 1);
    }
    header_ += (header_.empty() ? "\"" : ",\"") + column + "\"";
  }
}

bool NpzSource::NextLine(std::string_view* line) {
  if (row_ > rows_) return false;
  if (row_ == 0) {
    *line = header_;
  } else {
    line_.clear();
    for (const Array& array : arrays_) {
      for (long k = 0; k < array.values.columns(); ++k) {
        if (!line_.empty()) line_ += ',';
        array.values.AppendNumber(row_ - 1, k, &line_);
      }
    }
    *line = line_;
  }
  ++row_;
  return true;
}

}  // namespace armcal
