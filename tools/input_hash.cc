#include "tools/input_hash.h"

#include <filesystem>
#include <set>
#include <string_view>

#include "calib/numerics/sha256.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;

SourceFile HashArrays(const LogSource& log) {
  SourceFile source{log.name, "", 0};
  Sha256 hash;
  for (const LogArray& array : *log.arrays) {
    hash.Add(array.name + " " + std::to_string(array.rows) + " " +
             std::to_string(array.columns) + "\n");
    const std::string_view bytes =
        std::string_view(array.bytes).substr(array.begin);
    hash.Add(bytes);
    source.bytes += static_cast<long>(bytes.size());
  }
  source.sha256 = HexText(hash.Value());
  return source;
}

SourceFile HashFolder(const std::string& name) {
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(name)) {
    if (entry.is_regular_file()) files.insert(entry.path().string());
  }
  SourceFile source{name, "", 0};
  Sha256 hash;
  for (const std::string& path : files) {
    const SourceFile file = HashFile(path);
    hash.Add(file.sha256);
    source.bytes += file.bytes;
  }
  source.sha256 = HexText(hash.Value());
  return source;
}

}  // namespace

SourceFile HashInput(const CommandInput& input, const std::string& name) {
  const auto log = input.logs.find(name);
  if (log != input.logs.end()) return HashArrays(log->second);
  const std::string path = input.pipes->PathOf(name);
  std::error_code error;
  SourceFile source =
      fs::is_directory(path, error) ? HashFolder(path) : HashFile(path);
  source.path = name;
  return source;
}

}  // namespace armcal
