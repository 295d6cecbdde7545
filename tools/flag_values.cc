#include "tools/flag_values.h"

#include <gflags/gflags.h>
#include <glog/logging.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "tools/usage_error.h"

namespace armcal {
namespace {

gflags::CommandLineFlagInfo Definition(const std::string& name) {
  return gflags::GetCommandLineFlagInfoOrDie(name.c_str());
}

// What a wrong flag type is called in a message.
std::string TypeText(const std::string& gflags_type) {
  if (gflags_type == "double") return "a number";
  if (gflags_type == "bool") return "true or false";
  return gflags_type == "string" ? "a valid value" : "a whole number";
}

// The numbers that gflags takes: those of strtod, strtoll and strtoull that
// fill the text; whole ones may be hexadecimal.
template <class Parse>
auto WholeText(const std::string& text, Parse parse)
    -> std::optional<decltype(parse("", nullptr))> {
  if (text.empty()) return std::nullopt;
  errno = 0;
  char* end = nullptr;
  const auto number = parse(text.c_str(), &end);
  if (errno != 0 || end != text.c_str() + text.size()) return std::nullopt;
  return number;
}

int BaseOf(const std::string& text) {
  const bool hexadecimal = text.rfind("0x", 0) == 0 || text.rfind("0X", 0) == 0;
  return hexadecimal ? 16 : 10;
}

std::optional<double> ParseDouble(const std::string& text) {
  return WholeText(text, [](const char* begin, char** end) {
    return std::strtod(begin, end);
  });
}

std::optional<int> ParseInt32(const std::string& text) {
  const auto number = WholeText(text, [&](const char* begin, char** end) {
    return std::strtoll(begin, end, BaseOf(text));
  });
  if (!number || *number < std::numeric_limits<int32_t>::min() ||
      *number > std::numeric_limits<int32_t>::max()) {
    return std::nullopt;
  }
  return static_cast<int>(*number);
}

// strtoull takes a minus, and 2^64 less the number. Blanks alone are 0.
std::optional<uint64_t> ParseUint64(const std::string& text) {
  const size_t begin = std::min(text.find_first_not_of(' '), text.size());
  if (begin == text.size() && begin > 0) return 0;
  if (begin < text.size() && text[begin] == '-') return std::nullopt;
  return WholeText(text, [&](const char* first, char** end) {
    return static_cast<uint64_t>(std::strtoull(first, end, BaseOf(text)));
  });
}

std::optional<bool> ParseBool(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  for (const char* yes : {"1", "t", "true", "y", "yes"}) {
    if (text == yes) return true;
  }
  for (const char* no : {"0", "f", "false", "n", "no"}) {
    if (text == no) return false;
  }
  return std::nullopt;
}

template <class Value, class T>
std::optional<Value> AsValue(const std::optional<T>& parsed) {
  if (!parsed) return std::nullopt;
  return Value(*parsed);
}

// Nothing where the text is no value of the type.
template <class Value>
std::optional<Value> Parse(const std::string& type, const std::string& text) {
  if (type == "double") return AsValue<Value>(ParseDouble(text));
  if (type == "int32") return AsValue<Value>(ParseInt32(text));
  if (type == "uint64") return AsValue<Value>(ParseUint64(text));
  if (type == "bool") return AsValue<Value>(ParseBool(text));
  CHECK(type == "string") << type;
  return Value(text);
}

// As gflags writes them: every double can be read back.
struct Typed {
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(double number) const {
    char text[32];
    std::snprintf(text, sizeof(text), "%.17g", number);
    return text;
  }
  std::string operator()(int number) const { return std::to_string(number); }
  std::string operator()(uint64_t number) const {
    return std::to_string(number);
  }
  std::string operator()(bool on) const { return on ? "true" : "false"; }
};

}  // namespace

FlagValues::FlagValues(std::vector<std::string> names,
                       const std::vector<GivenFlag>& given)
    : names_(std::move(names)) {
  for (const GivenFlag& flag : given) {
    const std::string type = Definition(flag.name).type;
    const std::optional<Value> value = Parse<Value>(type, flag.value);
    if (!value) {
      throw UsageError(flag.place + "--" + flag.name + ": found '" +
                       flag.value + "', expected " + TypeText(type));
    }
    given_[flag.name] = *value;
  }
}

template <class T>
T FlagValues::Get(const std::string& name) const {
  const auto given = given_.find(name);
  if (given != given_.end()) return std::get<T>(given->second);
  const gflags::CommandLineFlagInfo definition = Definition(name);
  return std::get<T>(*Parse<Value>(definition.type, definition.default_value));
}

std::string FlagValues::Text(const std::string& name) const {
  return Get<std::string>(name);
}
double FlagValues::Number(const std::string& name) const {
  return Get<double>(name);
}
int FlagValues::Whole(const std::string& name) const { return Get<int>(name); }
uint64_t FlagValues::Natural(const std::string& name) const {
  return Get<uint64_t>(name);
}
bool FlagValues::Switch(const std::string& name) const {
  return Get<bool>(name);
}

bool FlagValues::IsDefault(const std::string& name) const {
  return given_.count(name) == 0;
}

std::vector<std::string> FlagValues::AsTyped() const {
  std::vector<std::string> typed;
  for (const std::string& name : names_) {
    const auto value = given_.find(name);
    if (value == given_.end()) continue;
    typed.push_back("--" + name + "=" + std::visit(Typed(), value->second));
  }
  return typed;
}

}  // namespace armcal
