#include "model/text/utf8.h"

namespace armcal {

void AppendUtf8(std::uint32_t c, std::string* text) {
  if (c < 0x80) {
    *text += static_cast<char>(c);
  } else if (c < 0x800) {
    *text += static_cast<char>(0xc0 | c >> 6);
    *text += static_cast<char>(0x80 | (c & 63));
  } else if (c < 0x10000) {
    *text += static_cast<char>(0xe0 | c >> 12);
    *text += static_cast<char>(0x80 | (c >> 6 & 63));
    *text += static_cast<char>(0x80 | (c & 63));
  } else {
    *text += static_cast<char>(0xf0 | (c >> 18 & 7));
    *text += static_cast<char>(0x80 | (c >> 12 & 63));
    *text += static_cast<char>(0x80 | (c >> 6 & 63));
    *text += static_cast<char>(0x80 | (c & 63));
  }
}

}  // namespace armcal
