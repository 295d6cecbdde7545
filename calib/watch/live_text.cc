#include "calib/watch/live_text.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "model/text/input_error.h"

namespace armcal {
namespace {

constexpr int kWaitMs = 50;
// A file that grows is looked at so often; a fifth of what a contact may take.
constexpr std::chrono::milliseconds kLookAgain(5);
constexpr size_t kLongestLine = 1 << 20;

double Now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

// What has to be whole before it can be read.
void RefuseBinary(const std::string& path, std::string_view first) {
  const auto begins = [&](std::string_view with) {
    return first.substr(0, with.size()) == with;
  };
  const bool bag = begins("SQLite format 3") || begins("\x89MCAP");
  if (bag) {
    throw InputError(
        path, "", "",
        "is a bag: one that is being written cannot be followed, as its "
        "messages are found by what is written last; print its topic into a "
        "pipe instead (docs/watch.md has the lines), or watch the bag when it "
        "is finished");
  }
  if (begins("\x1f\x8b") || begins("PK\3\4") || begins("MATLAB") ||
      first.find('\0') != first.npos) {
    throw InputError(path, "", "",
                     "is no text: only CSV can be followed while it is "
                     "written; unpack it, or watch it when it is finished");
  }
}

}  // namespace

LiveText::LiveText(const std::string& path, bool follow, double idle_s)
    : path_(path == "-" ? "standard input" : path),
      follow_(follow),
      idle_s_(idle_s),
      last_s_(Now()) {
  descriptor_ = path == "-" ? dup(STDIN_FILENO) : open(path.c_str(), O_RDONLY);
  struct stat status {};
  if (descriptor_ < 0 || fstat(descriptor_, &status) != 0) {
    throw InputError(path_, "", "",
                     std::string("cannot be opened: ") + std::strerror(errno));
  }
  if (S_ISDIR(status.st_mode)) {
    throw InputError(path_, "", "",
                     "is a folder: a bag that is being written cannot be "
                     "followed; print its topic into a pipe instead "
                     "(docs/watch.md has the lines)");
  }
  is_file_ = S_ISREG(status.st_mode);
}

LiveText::~LiveText() {
  if (descriptor_ >= 0) close(descriptor_);
}

LiveText::Got LiveText::Next(std::string_view* line) {
  for (;;) {
    const size_t feed = text_.find('\n', scanned_);
    if (feed != text_.npos) {
      *line = std::string_view(text_).substr(begin_, feed - begin_);
      begin_ = scanned_ = feed + 1;
      break;
    }
    scanned_ = text_.size();
    if (ended_) {
      if (begin_ == text_.size()) return Got::kEnd;
      *line = std::string_view(text_).substr(begin_);
      begin_ = text_.size();
      break;
    }
    if (Read() == Got::kNothing) return Got::kNothing;
  }
  if (!line->empty() && line->back() == '\r') line->remove_suffix(1);
  if (row_++ == 0 && line->substr(0, 3) == "\xef\xbb\xbf") {
    line->remove_prefix(3);
  }
  return Got::kLine;
}

// More text, kNothing yet, or the end of all.
LiveText::Got LiveText::Read() {
  if (text_.size() - begin_ > kLongestLine) {
    throw InputError(path_, "row " + std::to_string(row_ + 1), "",
                     "the line is longer than 1 MB; this is not a log in CSV");
  }
  text_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  if (!is_file_) {
    pollfd asked{descriptor_, POLLIN, 0};
    const int ready = poll(&asked, 1, kWaitMs);
    if (ready <= 0) {
      ended_ = follow_ && idle_s_ > 0 && Now() - last_s_ > idle_s_;
      return ended_ ? Got::kEnd : Got::kNothing;
    }
  }
  std::array<char, 1 << 16> bytes;
  const ssize_t size = read(descriptor_, bytes.data(), bytes.size());
  if (size < 0 && (errno == EINTR || errno == EAGAIN)) return Got::kNothing;
  if (size < 0) {
    throw InputError(path_, "", "",
                     std::string("cannot be read: ") + std::strerror(errno));
  }
  if (size == 0) return AtEndOfFile();
  if (read_ == 0) RefuseBinary(path_, {bytes.data(), size_t(size)});
  read_ += size;
  text_.append(bytes.data(), size);
  last_s_ = Now();
  return Got::kLine;
}

LiveText::Got LiveText::AtEndOfFile() {
  if (!is_file_ || !follow_) {
    ended_ = true;
    return Got::kEnd;
  }
  CheckFile();
  if (idle_s_ > 0 && Now() - last_s_ > idle_s_) {
    ended_ = true;
    return Got::kEnd;
  }
  std::this_thread::sleep_for(kLookAgain);
  return Got::kNothing;
}

void LiveText::CheckFile() const {
  struct stat opened {
  }, named{};
  if (fstat(descriptor_, &opened) != 0) return;
  if (opened.st_size < read_) {
    throw InputError(
        path_, "", "",
        "became shorter while it was followed: " + std::to_string(read_) +
            " bytes were read, it has " + std::to_string(opened.st_size) +
            "; watch the new one from its beginning");
  }
  if (path_ == "standard input") return;
  if (stat(path_.c_str(), &named) == 0 &&
      (named.st_ino != opened.st_ino || named.st_dev != opened.st_dev)) {
    throw InputError(path_, "", "",
                     "is another file than the one that was followed (it was "
                     "rotated or written anew); watch the new one from its "
                     "beginning");
  }
}

}  // namespace armcal
