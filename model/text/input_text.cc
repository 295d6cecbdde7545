#include "model/text/input_text.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "model/text/input_error.h"
#include "model/text/plain_text.h"

namespace armcal {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

}  // namespace

std::string ReadSmallFile(const std::string& path, long max_bytes,
                          std::string_view begin) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw InputError(path, "", "", "is a folder: expected a file");
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw InputError(path, "", "",
                     std::string("cannot be opened: ") + std::strerror(errno));
  }
  std::string text;
  std::vector<char> block(1 << 16);
  // By blocks, as a pipe does not know its size.
  while (file && text.size() <= static_cast<size_t>(max_bytes)) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    text.append(block.data(), static_cast<size_t>(file.gcount()));
    if (text.compare(0, begin.size(), begin) != 0) return text;
  }
  if (file.bad()) throw InputError(path, "", "", "cannot be read");
  if (text.size() > static_cast<size_t>(max_bytes)) {
    throw InputError(path, "", "",
                     "is larger than " + std::to_string(max_bytes >> 20) +
                         " MiB, the most that such a file may have");
  }
  return text;
}

std::string ReadTextFile(const std::string& path, long max_bytes) {
  std::string text = ReadSmallFile(path, max_bytes);
  if (Trim(text, kBlanks).empty())
    throw InputError(path, "", "", "the file is empty");
  RequirePlainText(path, text);
  return text;
}

std::string_view Trim(std::string_view text, std::string_view of) {
  const size_t first = text.find_first_not_of(of);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(of) - first + 1);
}

std::optional<double> ParseNumber(std::string_view text) {
  text = Trim(text, kBlanks);
  // A plus sign is what from_chars alone does not know; "+-1" is no number.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::vector<std::string_view> SplitWords(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = Trim(text, kBlanks); !text.empty(); text = Trim(text, kBlanks)) {
    const size_t length = std::min(text.find_first_of(kBlanks), text.size());
    words.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return words;
}

std::string WhyNotNumbers(std::string_view text, int count,
                          const std::string& unit, double* values) {
  const std::string what = std::string(count == 1 ? "number" : "numbers") +
                           (unit.empty() ? "" : " in " + unit);
  static const char* const kCounts[] = {"a ",    "two ",  "three ",
                                        "four ", "five ", "six "};
  const std::string many = kCounts[count - 1];
  const std::vector<std::string_view> words = SplitWords(text);
  const bool comma = text.find(',') != std::string_view::npos;
  const std::string expected =
      "expected " + many + what +
      (!comma       ? ""
       : count == 1 ? ", with a decimal point"
                    : ", with blanks between them and decimal points");
  if (static_cast<int>(words.size()) != count) return expected;
  for (int i = 0; i < count; ++i) {
    const std::optional<double> number = ParseNumber(words[i]);
    if (!number) return expected;
    if (!std::isfinite(*number)) {
      return "expected " + many + "finite " + what;
    }
    values[i] = *number;
  }
  return "";
}

std::string OneLine(std::string_view text) {
  constexpr size_t kMaxBytes = 80;
  size_t length = std::min(text.size(), kMaxBytes);
  if (length < text.size()) {
    // Do not cut a UTF-8 character in two.
    while (length > 0 && (text[length] & 0xC0) == 0x80) --length;
  }
  std::string line(text.substr(0, length));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return length < text.size() ? line + "..." : line;
}

std::string Quoted(std::string_view text) { return "'" + OneLine(text) + "'"; }

std::string JoinNames(const std::vector<std::string>& names) {
  constexpr size_t kMaxNames = 40;
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i == kMaxNames) {
      return text + " and " + std::to_string(names.size() - i) + " more";
    }
    text += (i > 0 ? ", " : "") + OneLine(names[i]);
  }
  return text;
}

std::string NumberText(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.6g", value);
  return buffer;
}

}  // namespace armcal
