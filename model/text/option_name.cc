#include "model/text/option_name.h"

#include <optional>

namespace armcal {
namespace {

// Made when it is first asked for, as messages may be constants.
std::optional<std::string>& Prefix() {
  static std::optional<std::string> prefix;
  return prefix;
}

}  // namespace

std::string OptionName(const std::string& name) {
  return Prefix() ? *Prefix() + name : "`" + name + "`";
}

void SetOptionPrefix(const std::string& prefix) { Prefix() = prefix; }

}  // namespace armcal
