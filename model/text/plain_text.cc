#include "model/text/plain_text.h"

#include "model/text/input_error.h"

namespace armcal {
namespace {

bool IsUtf16(std::string_view text) {
  return text.substr(0, 2) == "\xFF\xFE" || text.substr(0, 2) == "\xFE\xFF";
}

}  // namespace

void RequirePlainText(const std::string& name, std::string_view text) {
  if (IsUtf16(text)) {
    throw InputError(name, "", "", "is UTF-16: expected UTF-8 text");
  }
  if (text.find('\0') != std::string_view::npos) {
    throw InputError(name, "", "", "contains NUL bytes: expected UTF-8 text");
  }
}

}  // namespace armcal
