#include "tools/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "model/text/input_error.h"
#include "tools/interruption.h"
#include "tools/staged_files.h"

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

// `place`: the path to tell.
void WriteFile(const fs::path& path, const fs::path& place,
               const std::string& flag, const std::string& content) {
  constexpr size_t kPiece = 1 << 20;
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  for (size_t begin = 0; file && begin < content.size(); begin += kPiece) {
    CheckSignals();
    const size_t size = std::min(kPiece, content.size() - begin);
    file.write(content.data() + begin, static_cast<std::streamsize>(size));
  }
  file.close();
  if (!file) Refuse(place, flag, std::strerror(errno));
}

// Creates what of `path` is not there yet and adds it to `made`, outer first.
void Make(const fs::path& path, std::vector<fs::path>* made) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path at = path; !at.empty() && !fs::exists(at, error);
       at = at.parent_path()) {
    missing.push_back(at);
  }
  made->insert(made->end(), missing.rbegin(), missing.rend());
  fs::create_directories(path);
}

// Of a folder, against other runs; given up where the file system has none.
class Lock {
 public:
  explicit Lock(const fs::path& folder) {
    for (;;) {
      descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      Wait();
      struct stat locked, there;
      if (!held_ ||
          (stat(folder.c_str(), &there) == 0 &&
           fstat(descriptor_, &locked) == 0 && locked.st_ino == there.st_ino)) {
        return;
      }
      // The run that made the folder has failed and taken it away.
      close(descriptor_);
      fs::create_directories(folder);
    }
  }
  ~Lock() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  bool held() const { return held_; }

 private:
  void Wait() {
    for (;;) {
      held_ = flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
      if (held_ || errno != EWOULDBLOCK) return;
      CheckSignals();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }

  int descriptor_ = -1;
  bool held_ = false;
};

// What a series of files begins with: "robot_" of "robot_01.urdf".
std::string BeginningOf(const std::string& name) {
  return name.substr(0, name.find('_') + 1);
}

// Files in a folder that are of a series of `names` and none of them.
std::vector<std::string> OlderOf(const fs::path& folder,
                                 const std::set<std::string>& names) {
  if (names.empty()) return {};
  std::set<std::string> series;
  for (const std::string& name : names) series.insert(BeginningOf(name));
  std::vector<std::string> older;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename();
    const std::string beginning = BeginningOf(name);
    if (!beginning.empty() && series.count(beginning) > 0 &&
        names.count(name) == 0 && entry.is_regular_file()) {
      older.push_back(name);
    }
  }
  return older;
}

}  // namespace

// A folder that is written to, perhaps for several flags.
class OutputFolder::Place {
 public:
  struct File {
    const OutputFolder* of;
    std::string name;
    const std::string* content;
    bool in_series;  // in a folder of its own
  };

  void Add(const File& file) { files_.push_back(file); }

  void Write(const fs::path& path) {
    lock_.emplace(path);
    if (lock_->held()) StagedFiles::Recover(path);
    std::vector<std::string> names;
    std::set<std::string> series;
    for (const File& file : files_) {
      names.push_back(file.name);
      if (file.in_series) series.insert(file.name);
    }
    const std::vector<std::string> older = OlderOf(path, series);
    names.insert(names.end(), older.begin(), older.end());
    staged_.emplace(path, names);
    for (const File& file : files_) {
      WriteFile(staged_->Path(file.name), path / file.name, file.of->flag_,
                *file.content);
    }
    staged_->Link();
  }
  void Switch() { staged_->Switch(); }
  void Settle() {
    if (staged_) staged_->Settle();
  }
  const OutputFolder& folder() const { return *files_[0].of; }

 private:
  std::vector<File> files_;
  std::optional<Lock> lock_;
  std::optional<StagedFiles> staged_;
};

OutputFolder::OutputFolder(const std::string& path, const std::string& flag)
    : path_(path), flag_(flag) {}

void OutputFolder::Add(const std::string& name, std::string content) {
  files_.emplace_back(name, std::move(content));
}

void OutputFolder::WriteTogether(std::vector<OutputFolder>* folders) {
  const Uninterrupted whole_or_gone;
  std::vector<fs::path> made;
  // Each once and in one order, or runs might wait for each other.
  std::map<fs::path, Place> places;
  const OutputFolder* at_work = nullptr;
  try {
    for (const OutputFolder& folder : *folders) {
      if (folder.path_.empty()) continue;
      at_work = &folder;
      Make(folder.path_, &made);
      for (const auto& [name, content] : folder.files_) {
        const fs::path path = fs::path(folder.path_) / name;
        const bool in_series = fs::path(name).has_parent_path();
        if (in_series) Make(path.parent_path(), &made);
        places[fs::canonical(path.parent_path())].Add(
            {&folder, path.filename(), &content, in_series});
      }
    }
    for (auto& [path, place] : places) {
      at_work = &place.folder();
      place.Write(path);
    }
    for (auto& [path, place] : places) place.Switch();
    for (auto& [path, place] : places) place.Settle();
  } catch (...) {
    for (auto& [path, place] : places) place.Settle();
    // Not those that others write to.
    for (size_t k = made.size(); k-- > 0;) rmdir(made[k].c_str());
    try {
      throw;
    } catch (const fs::filesystem_error& error) {
      Refuse(at_work->path_, at_work->flag_, error.code().message());
    }
  }
}

}  // namespace armcal
