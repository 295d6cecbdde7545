#include "model/text/document.h"

#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/plain_text.h"

namespace armcal {

std::string Document::Text(long max_bytes) const {
  if (!text_) return ReadTextFile(name_, max_bytes);
  if (Trim(*text_, " \t\r\n").empty()) {
    throw InputError(name_, "", "", "the text is empty");
  }
  if (text_->size() > static_cast<size_t>(max_bytes)) {
    throw InputError(name_, "", "",
                     "is larger than " + std::to_string(max_bytes >> 20) +
                         " MiB, the most that such a text may have");
  }
  RequirePlainText(name_, *text_);
  return *text_;
}

}  // namespace armcal
