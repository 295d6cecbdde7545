#include "calib/numerics/json_value.h"

#include <cmath>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using nlohmann::json;

constexpr long kMostBytes = 16L << 20;
constexpr int kMostDepth = 100;

}  // namespace

void JsonValue::Refuse(const std::string& expected) const {
  const std::string text =
      value_.dump(-1, ' ', false, json::error_handler_t::replace);
  throw InputError(file_, key_.empty() ? "" : "key " + key_, OneLine(text),
                   expected);
}

bool JsonValue::Has(const std::string& key) const {
  return value_.is_object() && value_.contains(key);
}

JsonValue JsonValue::At(const std::string& key) const {
  if (!value_.is_object()) Refuse("expected an object");
  const std::string path = key_.empty() ? key : key_ + "." + key;
  if (!value_.contains(key)) {
    throw InputError(file_, "key " + path, "",
                     "is missing; expected a file that armcal wrote");
  }
  return JsonValue(file_, path, value_.at(key));
}

std::vector<JsonValue> JsonValue::Entries() const {
  if (!value_.is_array()) Refuse("expected a list");
  std::vector<JsonValue> entries;
  for (size_t k = 0; k < value_.size(); ++k) {
    entries.emplace_back(file_, key_ + "[" + std::to_string(k) + "]",
                         value_[k]);
  }
  return entries;
}

std::string JsonValue::Text() const {
  if (!value_.is_string()) Refuse("expected a text");
  return value_.get<std::string>();
}

double JsonValue::Number() const {
  if (!value_.is_number() || !std::isfinite(value_.get<double>())) {
    Refuse("expected a finite number");
  }
  return value_.get<double>();
}

double JsonValue::NumberOrNull() const {
  return value_.is_null() ? std::nan("") : Number();
}

long JsonValue::Count() const {
  constexpr double kMost = 9007199254740992;  // whole numbers are exact to 2^53
  const double number = Number();
  if (number < 0 || number > kMost || number != std::floor(number)) {
    Refuse("expected a whole number of at least 0");
  }
  return static_cast<long>(number);
}

bool JsonValue::Bool() const {
  if (!value_.is_boolean()) Refuse("expected true or false");
  return value_.get<bool>();
}

void JsonValue::Expect(const std::string& text, const std::string& why) const {
  if (Text() != text) Refuse("expected '" + text + "'" + why);
}

json ParseJson(const std::string& path, std::string_view text) {
  // What recursion goes through later, as in dump().
  const auto check = [&path](int depth, json::parse_event_t, json&) {
    if (depth <= kMostDepth) return true;
    throw InputError(path, "", "",
                     "expected JSON, as armcal writes it: lists and objects "
                     "are nested too deeply");
  };
  try {
    return json::parse(text, check);
  } catch (const json::parse_error& error) {
    throw InputError(path, "byte " + std::to_string(error.byte), "",
                     "expected JSON, as armcal writes it");
  } catch (const json::out_of_range&) {
    throw InputError(path, "", "",
                     "expected JSON, as armcal writes it: a number is too "
                     "large");
  }
}

json ReadJson(const std::string& path) {
  return ParseJson(path, ReadTextFile(path, kMostBytes));
}

}  // namespace armcal
