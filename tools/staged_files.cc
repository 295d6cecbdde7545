#include "tools/staged_files.h"

#include <unistd.h>

#include <filesystem>
#include <random>
#include <system_error>

namespace armcal {
namespace {

namespace fs = std::filesystem;

constexpr char kPrefix[] = ".armcal.";

// Differs between machines that share a folder, too.
std::string StageName() {
  std::random_device random;
  return kPrefix + std::to_string(getpid()) + "." + std::to_string(random());
}

// What stands in the place of a file.
fs::path LinkText(const fs::path& stage, const std::string& name) {
  return stage.filename() / "now" / name;
}

std::vector<std::string> Names(const fs::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    names.push_back(at->path().filename());
  }
  return names;
}

void SettleStage(const fs::path& stage) {
  const fs::path folder = stage.parent_path();
  std::error_code error;
  bool settled = true;
  for (const std::string& name : Names(folder)) {
    const fs::path place = folder / name;
    if (!fs::is_symlink(fs::symlink_status(place, error))) continue;
    if (fs::read_symlink(place, error) != LinkText(stage, name)) continue;
    const fs::path file = stage / "now" / name;
    if (fs::exists(fs::symlink_status(file, error))) {
      fs::rename(file, place, error);
    } else {
      fs::remove(place, error);
    }
    settled = settled && !error;
  }
  if (settled) fs::remove_all(stage, error);
}

}  // namespace

StagedFiles::StagedFiles(const std::string& folder,
                         std::vector<std::string> names)
    : folder_(folder),
      stage_(fs::path(folder) / StageName()),
      names_(std::move(names)) {
  fs::create_directories(fs::path(stage_) / "new");
}

std::string StagedFiles::Path(const std::string& name) const {
  return fs::path(stage_) / "new" / name;
}

// Hard links, or copies of what is another user's.
bool StagedFiles::KeepOld() const {
  const fs::path stage = stage_;
  std::error_code error;
  fs::create_directory(stage / "old", error);
  for (const std::string& name : names_) {
    const fs::path place = fs::path(folder_) / name;
    const fs::path kept = stage / "old" / name;
    const fs::file_status status = fs::symlink_status(place, error);
    if (fs::is_symlink(status)) {  // somebody's own, relative to its place
      fs::create_symlink(fs::absolute(folder_) / fs::read_symlink(place, error),
                         kept, error);
    } else if (fs::exists(status)) {
      fs::create_hard_link(place, kept, error);
      if (error) fs::copy_file(place, kept, error);
    } else {
      error.clear();
    }
    if (error) return false;
  }
  fs::create_directory_symlink("old", stage / "now", error);
  if (!error) fs::create_directory_symlink("new", stage / "then", error);
  return !error;
}

void StagedFiles::Link() {
  for (const std::string& name : names_) {
    const fs::path place = fs::path(folder_) / name;
    if (fs::is_directory(fs::symlink_status(place))) {
      throw fs::filesystem_error(
          "", place, std::make_error_code(std::errc::is_a_directory));
    }
  }
  linked_ = names_.size() > 1 && KeepOld();
  if (!linked_) return;
  const fs::path link = fs::path(stage_) / "link";
  for (const std::string& name : names_) {
    fs::create_symlink(LinkText(stage_, name), link);
    fs::rename(link, fs::path(folder_) / name);
  }
}

void StagedFiles::Switch() {
  if (linked_) {
    fs::rename(fs::path(stage_) / "then", fs::path(stage_) / "now");
    return;
  }
  for (const std::string& name : names_) {
    if (fs::exists(Path(name))) {
      fs::rename(Path(name), fs::path(folder_) / name);
    } else {
      fs::remove(fs::path(folder_) / name);
    }
  }
}

void StagedFiles::Settle() { SettleStage(stage_); }

void StagedFiles::Recover(const std::string& folder) {
  for (const std::string& name : Names(folder)) {
    if (name.rfind(kPrefix, 0) == 0) SettleStage(fs::path(folder) / name);
  }
}

}  // namespace armcal
