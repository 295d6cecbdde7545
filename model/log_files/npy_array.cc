#include "model/log_files/npy_array.h"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/utf8.h"

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

// What stands in the header after 'key': up to the next key or the end.
// Expressions are not evaluated, and regular expressions take a stack as deep
// as their text is long.
std::string_view ValueOf(std::string_view header, std::string_view key,
                         std::string_view next) {
  const size_t at = header.find(key);
  const size_t begin = at + key.size();
  const size_t end = at == header.npos ? at : header.find(next, begin);
  if (end == header.npos) return {};
  return Trim(header.substr(begin, end - begin), " ,");
}

// The kind and the bytes of an item of "'<f8'"; false for other types.
bool ReadType(std::string_view descr, LogArray* array) {
  if (descr.size() < 5 || descr.size() > 10 || descr.front() != '\'' ||
      descr.back() != '\'' || descr.find_first_of("<|=") != 1) {
    return false;
  }
  const char kind = descr[2];
  const char* const end = descr.data() + descr.size() - 1;
  int item = 0;
  const auto [stop, error] = std::from_chars(descr.data() + 3, end, item);
  if (error != std::errc() || stop != end ||
      std::string_view("fiuU").find(kind) == std::string_view::npos ||
      !IsWidth(kind, item)) {
    return false;
  }
  array->kind = kind;
  array->item = kind == 'U' ? 4 * item : item;
  return true;
}

// "{'descr': '<f8', 'fortran_order': False, 'shape': (100, 6), }"
void ReadHeader(const std::string& file, std::string_view header,
                LogArray* array) {
  const std::string_view descr = ValueOf(header, "'descr':", "'fortran_order'"),
                         order = ValueOf(header, "'fortran_order':", "'shape'"),
                         sizes = ValueOf(header, "'shape':", ")");
  if (descr.empty() || (order != "True" && order != "False") ||
      sizes.substr(0, 1) != "(" ||
      sizes.find_first_not_of("0123456789, ", 1) != sizes.npos) {
    Refuse(file, *array, "has a header that is not NumPy's");
  }
  array->by_column = order == "True";
  const std::vector<long> shape = ReadShape(file, *array, std::string(sizes));
  if (shape.empty() || shape.size() > 2) {
    array->why_none = "of " + std::to_string(shape.size()) + " dimensions";
    return;
  }
  if (!ReadType(descr, array)) {
    array->why_none =
        descr == "'|O'"
            ? "of Python objects, which are never unpickled"
            : "of type " + OneLine(descr) + ", not f4, f8 or an integer";
    return;
  }
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
  ReadHeader(file, std::string_view(array.bytes).substr(header, length),
             &array);
  if (array.kind != 'U') return array;
  for (long k = 0; k < array.rows && array.columns == 1; ++k) {
    array.texts.push_back(
        TextAt(data + array.begin + k * array.item, array.item));
  }
  array.kind = 0;
  array.why_none = "of texts";
  return array;
}

}  // namespace armcal
