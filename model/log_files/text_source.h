#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "model/log_files/line_source.h"
#include "model/text/input_error.h"

namespace armcal {

// A file whose size is another at its end than it was when it was opened: what
// was read of it is not what is there, whatever else is wrong with it.
class ChangedFile : public InputError {
 public:
  using InputError::InputError;
};

// The lines of a text file, plain or gzipped (told apart by the first two
// bytes, never by the name), read block by block: memory does not grow with the
// file.
//
// Throws InputError for what cannot be read as text: a missing file, a
// directory, a gzip stream that is truncated, damaged or followed by other
// bytes, NUL bytes, UTF-16, a line longer than a block; ChangedFile.
class TextSource : public LineSource {
 public:
  static constexpr int kBlockBytes = 1 << 20;

  // `block_bytes` is the longest line accepted; tests make it small.
  explicit TextSource(const std::string& path, int block_bytes = kBlockBytes)
      : TextSource(path, path, block_bytes) {}
  // `name` stands for the file in messages.
  TextSource(const std::string& path, const std::string& name,
             int block_bytes = kBlockBytes);
  ~TextSource() override;
  TextSource(TextSource&&) noexcept;

  // The next line without its LF or CRLF, and without a byte order mark if it
  // is the first; false at the end. *line lives until the next call.
  bool NextLine(std::string_view* line) override;
  // The lines that are whole in the block at hand; reads on for the first only.
  void NextLines(std::size_t most,
                 std::vector<std::string_view>* lines) override;
  // The 1-based number of the last line read, as an editor counts; 0 before.
  long row() const override;
  // Whether the last line read ended with the file instead of a line break.
  bool cut() const override;
  // Starts again at the first line. Throws for a pipe.
  void Rewind() override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace armcal
