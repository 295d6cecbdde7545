#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace armcal {

// The lines of a text that is still being written: a pipe ("-": standard
// input) or a file that grows. A line is given once its end has come, so that a
// half-written one waits.
//
// Throws InputError for a file that cannot be opened, is no text (gzip, bags,
// archives: their ends have to be there first), became shorter than what was
// read of it, or was replaced by another file; and for a line longer than 1 MB.
class LiveText {
 public:
  // `follow`: of a file, what is appended to it is waited for, until nothing
  // has come for `idle_s` seconds (0: for ever). A pipe ends when its writers
  // have closed it, or by `idle_s` where `follow` is set.
  LiveText(const std::string& path, bool follow, double idle_s);
  ~LiveText();
  LiveText(const LiveText&) = delete;

  enum class Got { kLine, kNothing, kEnd };
  // Waits for a line for a moment (50 ms) at most. *line lives until the next
  // call. A last line without an end is given at the end of what has one.
  Got Next(std::string_view* line);

  // As an editor counts, of the last line; 0 before.
  long row() const { return row_; }
  // Bytes that have come and are yet to be given.
  bool waiting() const { return begin_ < text_.size(); }

 private:
  Got Read();
  Got AtEndOfFile();
  void CheckFile() const;

  std::string path_;
  bool follow_, is_file_ = false;
  double idle_s_;
  int descriptor_ = -1;
  long read_ = 0;  // bytes
  std::string text_;
  size_t begin_ = 0, scanned_ = 0;
  long row_ = 0;
  double last_s_ = 0;  // when something came
  bool ended_ = false;
};

}  // namespace armcal
