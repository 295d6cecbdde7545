#include "tests/blind/blind_label.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "calib/numerics/json_value.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

using nlohmann::json;

std::optional<double> Figure(const json& object, const char* key) {
  if (!object.contains(key) || object.at(key).is_null()) return std::nullopt;
  return object.at(key).get<double>();
}

NamedEffect Placed(const json& entry) {
  return {entry.at("effect").get<std::string>(),
          entry.at("joint_index").get<int>()};
}

std::vector<NamedEffect> PlacedList(const json& object, const char* key) {
  std::vector<NamedEffect> list;
  if (!object.contains(key)) return list;
  for (const json& entry : object.at(key)) list.push_back(Placed(entry));
  return list;
}

// A value that JSON cannot hold (null) is none.
std::vector<NamedValue> Values(const json& list) {
  std::vector<NamedValue> values;
  for (const json& entry : list) {
    const auto value = Figure(entry, "value");
    values.push_back(
        {entry.at("name").get<std::string>(),
         entry.at("unit").get<std::string>(),
         value.value_or(std::numeric_limits<double>::quiet_NaN())});
  }
  return values;
}

double Removable(const json& oracle) {
  const auto refit = oracle.at("refit").get<std::vector<double>>();
  const auto after = oracle.at("after").get<std::vector<double>>();
  const auto floor = oracle.at("floor").get<std::vector<double>>();
  double sum = 0;
  for (size_t j = 0; j < floor.size(); ++j) {
    sum += (refit.at(j) - after.at(j)) / floor[j];
  }
  return sum / floor.size();
}

BlindLabel LabelOf(const json& file) {
  BlindLabel label;
  label.stratum = file.at("stratum").get<std::string>();
  label.arm = file.at("arm").get<std::string>();
  label.excitation = file.at("excitation").get<std::string>();
  label.log = file.value("log", "");
  for (const json& entry : file.at("effects")) {
    label.effects.push_back(
        {Placed(entry), entry.at("in_catalogue").get<bool>(),
         entry.at("enr").get<double>(), Values(entry.at("values")),
         entry.at("size_limit").get<std::string>()});
  }
  if (file.contains("oracle")) {
    label.oracle_removed_percent = Figure(file.at("oracle"), "removed_percent");
    label.removable = Removable(file.at("oracle"));
  }
  return label;
}

BlindAnswer::Gap GapOf(const json& file, const char* kind) {
  BlindAnswer::Gap gap;
  if (!file.contains("gap") || !file.at("gap").contains(kind)) return gap;
  const json& entry = file.at("gap").at(kind);
  if (!entry.is_object()) return gap;
  gap.removed_percent = Figure(entry, "removed_percent");
  gap.removed_from_nominal_percent =
      Figure(entry, "removed_from_nominal_percent");
  if (entry.contains("ci95") && entry.at("ci95").is_array() &&
      entry.at("ci95").size() == 2) {
    const auto& ci95 = entry.at("ci95");
    if (ci95[0].is_number()) gap.low = ci95[0].get<double>();
    if (ci95[1].is_number()) gap.high = ci95[1].get<double>();
  }
  gap.refit = Figure(entry, "refit");
  gap.after = Figure(entry, "after");
  return gap;
}

BlindAnswer AnswerOf(const json& file) {
  BlindAnswer answer;
  answer.verdict = file.at("verdict").get<std::string>();
  for (const json& entry : file.at("effects")) {
    answer.effects.push_back(
        {Placed(entry), entry.at("probability").get<double>(),
         Values(entry.at("estimates")), PlacedList(entry, "equivalent")});
  }
  answer.candidates = PlacedList(file, "candidates");
  answer.torque = GapOf(file, "torque");
  answer.forward = GapOf(file, "forward");
  return answer;
}

// What nlohmann says of a file that is not as it should be, as ours.
template <typename Read>
auto Checked(const std::string& path, const Read& read) {
  const json file = ReadJson(path);
  try {
    return read(file);
  } catch (const json::exception& error) {
    throw InputError(path, "", "", error.what());
  }
}

}  // namespace

std::string NamedEffect::Text() const {
  return joint_index == 0 ? effect : effect + "@" + std::to_string(joint_index);
}

double BlindLabel::least_enr() const {
  double least = effects.empty() ? 0 : effects[0].enr;
  for (const Effect& effect : effects) least = std::min(least, effect.enr);
  return least;
}

BlindLabel ReadBlindLabel(const std::string& path) {
  BlindLabel label = Checked(path, LabelOf);
  label.name = std::filesystem::path(path).stem();
  return label;
}

BlindAnswer ReadBlindAnswer(const std::string& path) {
  if (!std::filesystem::exists(path)) return {};
  return Checked(path, AnswerOf);
}

}  // namespace armcal
