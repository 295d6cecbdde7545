#include "model/log_files/npz_reader.h"

#include <algorithm>
#include <string_view>

#include "model/log_files/npy_array.h"
#include "model/text/zip_archive.h"

namespace armcal {
namespace {

std::string WithoutExtension(const std::string& name) {
  constexpr std::string_view kExtension = ".npy";
  const size_t stem = name.size() - std::min(name.size(), kExtension.size());
  return name.compare(stem, name.npos, kExtension) == 0 ? name.substr(0, stem)
                                                        : name;
}

}  // namespace

std::vector<LogArray> ReadNpz(const std::string& path) {
  const ZipArchive archive(path);
  std::vector<LogArray> arrays;
  for (const ZipEntry& entry : archive.entries()) {
    arrays.push_back(
        ReadNpy(path, WithoutExtension(entry.name), archive.Read(entry)));
  }
  return arrays;
}

}  // namespace armcal
