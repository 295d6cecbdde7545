#pragma once

#include <map>
#include <mutex>
#include <string>

namespace armcal {

// What comes out of pipes, kept for a second reading. A log is gone through
// several times, and a pipe gives its bytes once: they are copied into a
// temporary file (in $TMPDIR, else /tmp) without a name, which is gone when the
// process ends however it ends.
class SpooledPipes {
 public:
  SpooledPipes() = default;
  ~SpooledPipes();
  SpooledPipes(const SpooledPipes&) = delete;
  SpooledPipes& operator=(const SpooledPipes&) = delete;

  // What to open for `name`: itself, or of a pipe its copy, which is made the
  // first time, to the pipe's end. "-" is the standard input. Throws
  // InputError.
  std::string PathOf(const std::string& name);

 private:
  std::map<std::string, int> copies_;  // descriptors, by name
  std::mutex mutex_;
};

}  // namespace armcal
