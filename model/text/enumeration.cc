#include "model/text/enumeration.h"

namespace armcal {

std::string Enumeration(const std::vector<std::string>& names) {
  std::string text;
  for (size_t k = 0; k < names.size(); ++k) {
    const bool is_last = k + 1 == names.size();
    if (k > 0) text += is_last ? " and " : ", ";
    text += names[k];
  }
  return text;
}

}  // namespace armcal
