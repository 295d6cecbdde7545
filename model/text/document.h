#pragma once

#include <optional>
#include <string>
#include <utility>

namespace armcal {

// A text that is read as a whole: that of a file, or one that is in memory and
// has a file's name in messages.
class Document {
 public:
  // The file at `path`, which is not looked at yet. Readers take paths so.
  Document(std::string path) : name_(std::move(path)) {}  // NOLINT: implicit
  Document(const char* path) : name_(path) {}             // NOLINT: implicit
  // In memory; the ending of `name` says what it is, as a file's does.
  Document(std::string name, std::string text)
      : name_(std::move(name)), text_(std::move(text)) {}

  const std::string& name() const { return name_; }
  bool is_file() const { return !text_; }
  // Throws InputError where there is no such file, or it has more bytes.
  std::string Text(long max_bytes) const;

 private:
  std::string name_;
  std::optional<std::string> text_;
};

}  // namespace armcal
