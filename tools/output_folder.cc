#include "tools/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <set>
#include <thread>

#include "model/input_error.h"
#include "tools/interruption.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;

// Ends the writing of results, and unwinding the signal ends armcal: main() has
// to know this for an exception that it catches, or nothing is unwound.
class Interruption : public std::exception {};

void CheckSignals() {
  if (Uninterrupted::IsAwaited()) throw Interruption();
}

[[noreturn]] void Refuse(const fs::path& path, const std::string& flag,
                         const std::string& why) {
  throw InputError(path.string(), flag, "", "cannot be written: " + why);
}

void WriteFile(const fs::path& path, const std::string& flag,
               const std::string& content) {
  constexpr size_t kPiece = 1 << 20;
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  for (size_t begin = 0; file && begin < content.size(); begin += kPiece) {
    CheckSignals();
    const size_t size = std::min(kPiece, content.size() - begin);
    file.write(content.data() + begin, static_cast<std::streamsize>(size));
  }
  file.close();
  if (!file) Refuse(path, flag, std::strerror(errno));
}

// Those of `path` that are not there yet, outer first.
std::vector<std::string> MissingFolders(fs::path path) {
  std::vector<std::string> missing;
  std::error_code error;
  for (; !path.empty() && !fs::exists(path, error); path = path.parent_path()) {
    missing.insert(missing.begin(), path.string());
  }
  return missing;
}

// Differs between machines that share a folder, too.
std::string RunSuffix() {
  std::random_device random;
  return ".tmp" + std::to_string(getpid()) + "." + std::to_string(random());
}

}  // namespace

// Given up where the file system has no locks.
class OutputFolder::Lock {
 public:
  explicit Lock(const std::string& folder)
      : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    while (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      CheckSignals();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  ~Lock() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int descriptor_;
};

OutputFolder::OutputFolder(const std::string& path, const std::string& flag)
    : path_(path), flag_(flag), suffix_(RunSuffix()) {}

void OutputFolder::Add(const std::string& name, std::string content) {
  files_.emplace_back(name, std::move(content));
}

std::string OutputFolder::Temporary(const std::string& name) const {
  return fs::path(path_) / (name + suffix_);
}

void OutputFolder::WriteTemporaries() {
  if (path_.empty()) return;
  std::error_code error;
  made_ = MissingFolders(path_);
  fs::create_directories(path_, error);
  if (error) Refuse(path_, flag_, error.message());
  for (const auto& [name, content] : files_) {
    WriteFile(Temporary(name), flag_, content);
  }
}

void OutputFolder::RenameThem() const {
  if (path_.empty()) return;
  std::error_code error;
  for (const auto& file : files_) {
    const fs::path path = fs::path(path_) / file.first;
    fs::rename(Temporary(file.first), path, error);
    if (error) Refuse(path, flag_, error.message());
  }
}

void OutputFolder::RemoveThem() const {
  std::error_code error;
  for (const auto& file : files_) fs::remove(Temporary(file.first), error);
  for (size_t k = made_.size(); k-- > 0;) {
    if (rmdir(made_[k].c_str()) != 0) break;  // others write there, too
  }
}

void OutputFolder::WriteTogether(std::vector<OutputFolder>* folders) {
  const Uninterrupted whole_or_gone;
  try {
    for (OutputFolder& folder : *folders) folder.WriteTemporaries();
    // Each once and in one order, or runs might wait for each other.
    std::set<std::string> paths;
    for (const OutputFolder& folder : *folders) {
      if (!folder.path_.empty()) paths.insert(fs::canonical(folder.path_));
    }
    std::vector<std::unique_ptr<Lock>> locks;
    for (const std::string& path : paths) {
      locks.push_back(std::make_unique<Lock>(path));
    }
    for (const OutputFolder& folder : *folders) folder.RenameThem();
  } catch (...) {
    for (const OutputFolder& folder : *folders) folder.RemoveThem();
    throw;
  }
}

}  // namespace armcal
