#include "tools/spooled_pipes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "model/text/input_error.h"
#include "model/text/write_all.h"

namespace armcal {
namespace {

[[noreturn]] void Refuse(const std::string& name, const std::string& what) {
  throw InputError(name, "", "", what + ": " + std::strerror(errno));
}

bool IsPipe(const std::string& path) {
  struct stat status;
  return stat(path.c_str(), &status) == 0 &&
         (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
}

// A file that has lost its name, open for reading and writing.
int TemporaryFile(const std::string& name) {
  const char* folder = std::getenv("TMPDIR");
  if (folder == nullptr || *folder == '\0') folder = "/tmp";
  std::string path = std::string(folder) + "/armcal_pipe_XXXXXX";
  const int file = mkostemp(path.data(), O_CLOEXEC);
  if (file < 0) {
    Refuse(name, std::string("is a pipe, which cannot be kept in ") + folder +
                     " ($TMPDIR says where)");
  }
  unlink(path.c_str());
  return file;
}

// Bytes that were read; interrupted calls are made again.
ssize_t ReadSome(int from, std::vector<char>* block) {
  ssize_t size;
  do {
    size = read(from, block->data(), block->size());
  } while (size < 0 && errno == EINTR);
  return size;
}

// A twentieth of the file system is left to others: a pipe may have no end.
bool HasRoom(int file) {
  struct statvfs status;
  if (fstatvfs(file, &status) != 0) return true;
  if (status.f_bavail > status.f_blocks / 20) return true;
  errno = ENOSPC;
  return false;
}

// Closes what it holds.
struct OpenFile {
  int descriptor;
  ~OpenFile() {
    if (descriptor >= 0) close(descriptor);
  }
  int Release() { return std::exchange(descriptor, -1); }
};

int CopyOf(const std::string& name, const std::string& path) {
  const OpenFile pipe{open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (pipe.descriptor < 0) Refuse(name, "cannot be opened");
  OpenFile copy{TemporaryFile(name)};
  std::vector<char> block(1 << 20);
  while (true) {
    const ssize_t size = ReadSome(pipe.descriptor, &block);
    if (size < 0) Refuse(name, "cannot be read");
    if (size == 0) return copy.Release();
    if (!HasRoom(copy.descriptor) ||
        !WriteAll(copy.descriptor, block.data(), static_cast<size_t>(size))) {
      Refuse(name,
             "is a pipe, whose bytes do not fit where they are kept for a "
             "second reading ($TMPDIR says where)");
    }
  }
}

}  // namespace

SpooledPipes::~SpooledPipes() {
  for (const auto& [name, descriptor] : copies_) close(descriptor);
}

// A copy has no name: whoever opens the link that the system has for its
// descriptor starts at its first byte.
std::string SpooledPipes::PathOf(const std::string& name) {
  const std::string path = name == "-" ? "/dev/stdin" : name;
  const std::lock_guard<std::mutex> lock(mutex_);
  auto copy = copies_.find(name);
  if (copy == copies_.end()) {
    if (!IsPipe(path)) return path;
    copy = copies_.emplace(name, CopyOf(name, path)).first;
  }
  return "/proc/self/fd/" + std::to_string(copy->second);
}

}  // namespace armcal
