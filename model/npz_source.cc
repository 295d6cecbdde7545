#include "model/npz_source.h"

#include <algorithm>
#include <map>

#include "model/input_error.h"
#include "model/input_text.h"
#include "model/zip_archive.h"

namespace armcal {
namespace {

// What others call a log's signals.
const std::map<std::string, std::string> kSignalNames = {
    {"position", "q"},
    {"velocity", "qd"},
    {"acceleration", "qdd"},
    {"effort", "tau"},
    {"torque", "tau"},
    {"current", "i"},
    {"reference", "qref"},
    {"temperature", "temp"},
    {"q", "q"},
    {"qd", "qd"},
    {"qdd", "qdd"},
    {"tau", "tau"},
    {"i", "i"},
    {"qref", "qref"},
    {"temp", "temp"}};
// And each joint's, where joints have names.
const std::map<std::string, std::string> kJointSignals = {
    {"q", "position"},      {"qd", "velocity"}, {"qdd", "acceleration"},
    {"tau", "effort"},      {"i", "current"},   {"qref", "reference"},
    {"temp", "temperature"}};

bool IsOneOf(const std::string& name,
             std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool IsTime(const std::string& name) {
  return IsOneOf(name, {"t", "time", "timestamp", "__time"});
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
    if (IsTime(name)) rows_ = std::max(rows_, values.rows());
    found.push_back({name, std::move(values)});
  }
  if (std::none_of(found.begin(), found.end(),
                   [](const Array& a) { return IsTime(a.name); })) {
    throw InputError(path, "", "",
                     "has no array of times: expected t, time or timestamp");
  }
  for (Array& array : found) {
    const bool signal = kSignalNames.count(array.name) > 0;
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
  const auto signal = kSignalNames.find(array.name);
  const std::string name =
      signal == kSignalNames.end() ? array.name : signal->second;
  const long columns = array.values.columns();
  for (long k = 0; k < columns; ++k) {
    std::string column = name;
    if (signal != kSignalNames.end()) {
      column = static_cast<long>(joints.size()) == columns
                   ? joints[k] + "/" + kJointSignals.at(name)
                   : name + std::to_string(k + 1);
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
