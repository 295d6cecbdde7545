#include "tests/blind/equivalents.h"

#include "calib/numerics/json_value.h"

namespace armcal {
namespace {

NamedEffect Read(const JsonValue& entry) {
  return {entry.At("effect").Text(),
          static_cast<int>(entry.At("joint_index").Number())};
}

}  // namespace

Equivalents::Equivalents(const std::string& path) {
  const nlohmann::json file = ReadJson(path);
  for (const auto& [arm, pairs] : file.items()) {
    for (const JsonValue& pair : JsonValue(path, arm, pairs).Entries()) {
      Add(arm, Read(pair.At("a")), Read(pair.At("b")),
          pair.At("cosine").Number());
    }
  }
}

void Equivalents::Add(const std::string& arm, const NamedEffect& a,
                      const NamedEffect& b, double cosine) {
  arms_[arm].push_back({a, b, cosine});
}

bool Equivalents::Hold(const std::string& arm, const NamedEffect& a,
                       const NamedEffect& b) const {
  const auto found = arms_.find(arm);
  if (found == arms_.end()) return false;
  for (const Pair& pair : found->second) {
    if ((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a)) {
      return true;
    }
  }
  return false;
}

}  // namespace armcal
