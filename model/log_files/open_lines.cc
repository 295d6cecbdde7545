#include "model/log_files/open_lines.h"

#include <filesystem>

#include "model/log_files/array_source.h"
#include "model/log_files/bag_source.h"
#include "model/log_files/mat_reader.h"
#include "model/log_files/npz_reader.h"
#include "model/log_files/text_source.h"
#include "model/ros_bags/bag_file.h"
#include "model/ros_bags/open_bag.h"
#include "model/text/first_bytes.h"
#include "model/text/input_error.h"
#include "model/text/unpack.h"

namespace armcal {
namespace {

// What is told apart to say what to do about it.
void RefuseOthers(const std::string& path, const std::string& first) {
  if (first.rfind("#ROSBAG", 0) == 0) {
    throw InputError(path, "", "",
                     "is a bag of ROS 1: `python3 -m armcal.convert " + path +
                         " FOLDER` makes one of ROS 2");
  }
  if (first.rfind("PAR1", 0) == 0) {
    throw InputError(path, "", "",
                     "is a Parquet file: `python3 -m armcal.convert " + path +
                         " log.npz` makes an .npz");
  }
  if (IsZstd(first)) {
    throw InputError(path, "", "",
                     "is packed by zstd as a whole: unpack it with unzstd");
  }
}

}  // namespace

std::unique_ptr<LineSource> OpenLines(const LogSource& log,
                                      const LineOptions& options) {
  if (log.arrays != nullptr) {
    return std::make_unique<ArraySource>(log.name, *log.arrays);
  }
  const std::string& path = log.path();
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return std::make_unique<BagSource>(path, options);
  }
  // A pipe would lose what is looked at.
  if (std::filesystem::is_regular_file(path, error)) {
    const std::string first = FirstBytes(path);
    if (IsBagFile(first)) return std::make_unique<BagSource>(path, options);
    if (first.rfind("PK\3\4", 0) == 0) {
      return std::make_unique<ArraySource>(log.name, ReadNpz(path));
    }
    if (IsMatFile(first)) {
      return std::make_unique<ArraySource>(log.name, ReadMat(path));
    }
    RefuseOthers(log.name, first);
  }
  return std::make_unique<TextSource>(path, log.name);
}

}  // namespace armcal
