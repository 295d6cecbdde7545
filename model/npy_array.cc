#include "model/npy_array.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <regex>

#include "model/input_error.h"
#include "model/input_text.h"

namespace armcal {
namespace {

template <typename T>
T ValueAt(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <typename T>
void Append(const char* bytes, std::string* line) {
  std::array<char, 40> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), ValueAt<T>(bytes));
  line->append(text.data(), end.ptr);
}

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

}  // namespace

NpyArray::NpyArray(const std::string& file, const std::string& name,
                   std::string bytes)
    : file_(file), name_(name), bytes_(std::move(bytes)) {
  if (bytes_.size() < 12 || bytes_.compare(0, 6, "\x93NUMPY") != 0) {
    Refuse("is not in NumPy's .npy format");
  }
  const bool short_length = bytes_[6] == 1;
  const size_t header = short_length ? 10 : 12;
  const size_t length = short_length
                            ? ValueAt<std::uint16_t>(bytes_.data() + 8)
                            : ValueAt<std::uint32_t>(bytes_.data() + 8);
  constexpr size_t kMostHeader = 65536;
  if (length > kMostHeader || header + length > bytes_.size()) {
    Refuse("has a damaged header");
  }
  begin_ = header + length;
  ReadHeader(bytes_.substr(header, length));
}

// "{'descr': '<f8', 'fortran_order': False, 'shape': (100, 6), }"
void NpyArray::ReadHeader(const std::string& header) {
  static const std::regex format(
      R"(^\{'descr': *(.*), *'fortran_order': *(True|False), *'shape': *\(([0-9, ]*)\), *\}\s*$)");
  static const std::regex simple(R"(^'([<|=])([fiuU])([0-9]{1,6})'$)");
  std::smatch match, type;
  if (!std::regex_match(header, match, format)) {
    Refuse("has a header that is not NumPy's");
  }
  fortran_ = match[2] == "True";
  const std::string sizes = match[3];
  for (size_t at = 0;
       (at = sizes.find_first_of("0123456789", at)) != sizes.npos;) {
    const size_t end = std::min(sizes.size(), sizes.find_first_of(", ", at));
    long size = 0;
    if (std::from_chars(&sizes[at], sizes.data() + end, size).ec !=
        std::errc()) {
      Refuse("has a damaged header");
    }
    shape_.push_back(size);
    at = end;
  }
  const std::string descr = match[1];
  if (shape_.empty() || shape_.size() > 2 ||
      !std::regex_match(descr, type, simple)) {
    return;  // not of use to anyone here
  }
  const char kind = type[2].str()[0];
  item_ = std::stoi(type[3]);
  const bool sizes_fit =
      kind == 'f'   ? item_ == 4 || item_ == 8
      : kind == 'U' ? item_ > 0
                    : item_ == 1 || item_ == 2 || item_ == 4 || item_ == 8;
  if (!sizes_fit) return;
  kind_ = kind;
  if (kind == 'U') item_ *= 4;
  const size_t there = (bytes_.size() - begin_) / item_;
  if (columns() > 0 &&
      static_cast<size_t>(rows()) > there / static_cast<size_t>(columns())) {
    Refuse("is cut off");
  }
}

void NpyArray::AppendNumber(long row, long column, std::string* line) const {
  const long index =
      fortran_ ? column * rows() + row : row * columns() + column;
  const char* at = bytes_.data() + begin_ + index * item_;
  if (kind_ == 'f') {
    item_ == 8 ? Append<double>(at, line) : Append<float>(at, line);
  } else if (kind_ == 'i') {
    item_ == 8   ? Append<std::int64_t>(at, line)
    : item_ == 4 ? Append<std::int32_t>(at, line)
    : item_ == 2 ? Append<std::int16_t>(at, line)
                 : Append<std::int8_t>(at, line);
  } else {
    item_ == 8   ? Append<std::uint64_t>(at, line)
    : item_ == 4 ? Append<std::uint32_t>(at, line)
    : item_ == 2 ? Append<std::uint16_t>(at, line)
                 : Append<std::uint8_t>(at, line);
  }
}

std::string NpyArray::Text(long row) const {
  std::string text;
  const char* at = bytes_.data() + begin_ + row * item_;
  for (int k = 0; k < item_; k += 4) {
    const auto c = ValueAt<std::uint32_t>(at + k);
    if (c != 0) AppendUtf8(c, &text);
  }
  return text;
}

void NpyArray::Refuse(const std::string& why) const {
  throw InputError(file_, "array " + OneLine(name_), "", why);
}

}  // namespace armcal
