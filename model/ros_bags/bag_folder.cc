#include "model/ros_bags/bag_folder.h"

#include <algorithm>
#include <filesystem>

#include "model/ros_bags/bag_file.h"
#include "model/ros_bags/open_bag.h"
#include "model/text/first_bytes.h"
#include "model/text/input_error.h"
#include "model/text/unpack.h"
#include "model/text/yaml_node.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> FilesInMetadata(const fs::path& metadata) {
  std::vector<std::string> files;
  for (const YamlNode& entry : YamlNode::ReadFile(metadata.string())
                                   .RequiredChild("rosbag2_bagfile_information")
                                   .RequiredChild("relative_file_paths")
                                   .Entries()) {
    // Older ones name the folder as well; others have no say in where to look.
    const fs::path name = fs::path(entry.Name()).filename();
    const std::string file = (metadata.parent_path() / name).string();
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      entry.Refuse("this file is not in the folder");
    }
    if (std::count(files.begin(), files.end(), file) > 0) {
      entry.Refuse("this file is named twice");
    }
    files.push_back(file);
  }
  return files;
}

// By their names, whose numbers have no zeros before.
std::vector<std::string> BagsIn(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().string();
    if (entry.is_regular_file(error) && IsBagFile(FirstBytes(file))) {
      files.push_back(file);
    }
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  return files;
}

}  // namespace

std::vector<std::string> BagFiles(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  const fs::path metadata = fs::path(path) / "metadata.yaml";
  const std::vector<std::string> files =
      fs::exists(metadata, error) ? FilesInMetadata(metadata) : BagsIn(path);
  if (files.empty()) {
    throw InputError(path, "", "",
                     "is a folder without a bag: expected one of rosbag2, with "
                     "metadata.yaml and .db3 or .mcap files");
  }
  for (const std::string& file : files) {
    const std::string first = FirstBytes(file);
    if (IsBagFile(first)) continue;
    throw InputError(file, "", "",
                     IsZstd(first)
                         ? "is packed by zstd as a whole: unpack it with "
                           "unzstd and name the file"
                         : "is not a bag: expected SQLite or MCAP");
  }
  return files;
}

}  // namespace armcal
