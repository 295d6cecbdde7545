#include "model/npy_array.h"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <regex>

#include "model/input_error.h"
#include "model/input_text.h"
#include "model/utf8.h"

namespace armcal {
namespace {

template <typename T>
T ValueAt(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

[[noreturn]] void Refuse(const std::string& file, const LogArray& array,
                         const std::string& why) {
  throw InputError(file, "array " + OneLine(array.name), "", why);
}

bool IsWidth(char kind, int item) {
  if (kind == 'f') return item == 4 || item == 8;
  if (kind == 'U') return item > 0;
  return item == 1 || item == 2 || item == 4 || item == 8;
}

// The numbers of "(100, 6)".
std::vector<long> ReadShape(const std::string& file, const LogArray& array,
                            const std::string& sizes) {
  std::vector<long> shape;
  for (size_t at = 0;
       (at = sizes.find_first_of("0123456789", at)) != sizes.npos;) {
    const size_t end = std::min(sizes.size(), sizes.find_first_of(", ", at));
    long size = 0;
    if (std::from_chars(&sizes[at], sizes.data() + end, size).ec !=
        std::errc()) {
      Refuse(file, array, "has a damaged header");
    }
    shape.push_back(size);
    at = end;
  }
  return shape;
}

// "{'descr': '<f8', 'fortran_order': False, 'shape': (100, 6), }"
void ReadHeader(const std::string& file, const std::string& header,
                LogArray* array) {
  static const std::regex format(
      R"(^\{'descr': *(.*), *'fortran_order': *(True|False), *'shape': *\(([0-9, ]*)\), *\}\s*$)");
  static const std::regex simple(R"(^'([<|=])([fiuU])([0-9]{1,6})'$)");
  std::smatch match, type;
  if (!std::regex_match(header, match, format)) {
    Refuse(file, *array, "has a header that is not NumPy's");
  }
  array->by_column = match[2] == "True";
  const std::vector<long> shape = ReadShape(file, *array, match[3]);
  const std::string descr = match[1];
  if (shape.empty() || shape.size() > 2 ||
      !std::regex_match(descr, type, simple)) {
    return;  // not of use to anyone here
  }
  const char kind = type[2].str()[0];
  const int item = std::stoi(type[3]);
  if (!IsWidth(kind, item)) return;
  array->kind = kind;
  array->item = kind == 'U' ? 4 * item : item;
  array->rows = shape[0];
  array->columns = shape.size() < 2 ? 1 : shape[1];
  const size_t there = (array->bytes.size() - array->begin) / array->item;
  if (array->columns > 0 && static_cast<size_t>(array->rows) >
                                there / static_cast<size_t>(array->columns)) {
    Refuse(file, *array, "is cut off");
  }
}

std::string TextAt(const char* at, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; k += 4) {
    const auto c = ValueAt<std::uint32_t>(at + k);
    if (c != 0) AppendUtf8(c, &text);
  }
  return text;
}

}  // namespace

LogArray ReadNpy(const std::string& file, const std::string& name,
                 std::string bytes) {
  LogArray array;
  array.name = name;
  array.bytes = std::move(bytes);
  const char* const data = array.bytes.data();
  const size_t size = array.bytes.size();
  if (size < 12 || array.bytes.compare(0, 6, "\x93NUMPY") != 0) {
    Refuse(file, array, "is not in NumPy's .npy format");
  }
  const bool short_length = data[6] == 1;
  const size_t header = short_length ? 10 : 12;
  const size_t length = short_length ? ValueAt<std::uint16_t>(data + 8)
                                     : ValueAt<std::uint32_t>(data + 8);
  constexpr size_t kMostHeader = 65536;
  if (length > kMostHeader || header + length > size) {
    Refuse(file, array, "has a damaged header");
  }
  array.begin = header + length;
  ReadHeader(file, array.bytes.substr(header, length), &array);
  if (array.kind != 'U') return array;
  for (long k = 0; k < array.rows && array.columns == 1; ++k) {
    array.texts.push_back(
        TextAt(data + array.begin + k * array.item, array.item));
  }
  array.kind = 0;
  return array;
}

}  // namespace armcal
