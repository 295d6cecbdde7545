#include "tools/command.h"

namespace armcal {

std::vector<std::string> Command::FlagNames() const {
  std::vector<std::string> names;
  for (const FlagGroup& group : groups) {
    names.insert(names.end(), group.flags.begin(), group.flags.end());
  }
  return names;
}

}  // namespace armcal
