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

}  // namespace

void OutputFolder::Add(const std::string& name, std::string content) {
  files_.emplace_back(name, std::move(content));
}

void OutputFolder::Write() const {
  if (path_.empty()) return;
  std::error_code error;
  const fs::path folder(path_);
  fs::create_directories(folder, error);
  if (error) Refuse(folder, flag_, error.message());
  const std::string ending = ".tmp" + std::to_string(getpid());
  try {
    for (const auto& [name, content] : files_) {
      WriteFile(folder / (name + ending), flag_, content);
    }
    for (const auto& file : files_) {
      fs::rename(folder / (file.first + ending), folder / file.first, error);
      if (error) Refuse(folder / file.first, flag_, error.message());
    }
  } catch (...) {
    for (const auto& file : files_) {
      fs::remove(folder / (file.first + ending), error);
    }
    throw;
  }
}

}  // namespace armcal
