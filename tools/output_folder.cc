#include "tools/output_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "model/input_error.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Refuse(const fs::path& path, const std::string& flag,
                         const std::string& why) {
  throw InputError(path.string(), flag, "", "cannot be written: " + why);
}

void WriteFile(const fs::path& path, const std::string& flag,
               const std::string& content) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file << content;
  file.close();
  if (!file) Refuse(path, flag, std::strerror(errno));
}

fs::path Temporary(const std::string& folder, const std::string& name) {
  return fs::path(folder) / (name + ".tmp" + std::to_string(getpid()));
}

}  // namespace

void OutputFolder::Add(const std::string& name, std::string content) {
  files_.emplace_back(name, std::move(content));
}

void OutputFolder::WriteTemporaries() const {
  if (path_.empty()) return;
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) Refuse(path_, flag_, error.message());
  for (const auto& [name, content] : files_) {
    WriteFile(Temporary(path_, name), flag_, content);
  }
}

void OutputFolder::RenameThem() const {
  if (path_.empty()) return;
  std::error_code error;
  for (const auto& file : files_) {
    const fs::path path = fs::path(path_) / file.first;
    fs::rename(Temporary(path_, file.first), path, error);
    if (error) Refuse(path, flag_, error.message());
  }
}

void OutputFolder::RemoveThem() const {
  std::error_code error;
  for (const auto& file : files_) {
    fs::remove(Temporary(path_, file.first), error);
  }
}

void OutputFolder::WriteTogether(
    const std::vector<const OutputFolder*>& folders) {
  try {
    for (const OutputFolder* folder : folders) folder->WriteTemporaries();
    for (const OutputFolder* folder : folders) folder->RenameThem();
  } catch (...) {
    for (const OutputFolder* folder : folders) folder->RemoveThem();
    throw;
  }
}

}  // namespace armcal
