#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace armcal {

// A value of a JSON file that users give, with the key it stands at: what is
// not as asked for throws InputError with file, key, value and expectation.
// Refers to the file's name and to the JSON, which must outlive it.
class JsonValue {
 public:
  JsonValue(const std::string& file, const std::string& key,
            const nlohmann::json& value)
      : file_(file), key_(key), value_(value) {}

  const std::string& file() const { return file_; }
  [[noreturn]] void Refuse(const std::string& expected) const;

  bool Has(const std::string& key) const;
  JsonValue At(const std::string& key) const;  // of an object
  std::vector<JsonValue> Entries() const;      // of a list
  std::string Text() const;
  double Number() const;        // finite
  double NumberOrNull() const;  // NaN where it is null
  long Count() const;           // a whole number, not negative
  bool Bool() const;
  // Refuses any text but this one; `why` goes after it in the message.
  void Expect(const std::string& text, const std::string& why) const;

 private:
  const std::string& file_;
  std::string key_;  // "joints[2].name"; empty: the whole file
  const nlohmann::json& value_;
};

// Throw InputError where the file cannot be read or `text`, which stands in it,
// is no JSON.
nlohmann::json ReadJson(const std::string& path);
nlohmann::json ParseJson(const std::string& path, std::string_view text);

}  // namespace armcal
