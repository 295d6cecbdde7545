#include "model/line_source.h"

#include <filesystem>

#include "model/array_source.h"
#include "model/bag_file.h"
#include "model/bag_source.h"
#include "model/first_bytes.h"
#include "model/input_error.h"
#include "model/mat_reader.h"
#include "model/npz_reader.h"
#include "model/text_source.h"
#include "model/unpack.h"

namespace armcal {
namespace {

// What is told apart to say what to do about it.
void RefuseOthers(const std::string& path, const std::string& first) {
  if (first.rfind("#ROSBAG", 0) == 0) {
    throw InputError(path, "", "",
                     "is a bag of ROS 1: convert it, `rosbags-convert --src " +
                         path + " --dst FOLDER` makes one of ROS 2");
  }
  if (IsZstd(first)) {
    throw InputError(path, "", "",
                     "is packed by zstd as a whole: unpack it with unzstd");
  }
}

}  // namespace

void LineSource::NextLines(std::size_t, std::vector<std::string_view>* lines) {
  lines->clear();
  std::string_view line;
  if (NextLine(&line)) lines->push_back(line);
}

std::unique_ptr<LineSource> OpenLines(const std::string& path,
                                      const LineOptions& options) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return std::make_unique<BagSource>(path, options);
  }
  // A pipe would lose what is looked at.
  if (std::filesystem::is_regular_file(path, error)) {
    const std::string first = FirstBytes(path);
    if (IsBagFile(first)) return std::make_unique<BagSource>(path, options);
    if (first.rfind("PK\3\4", 0) == 0) {
      return std::make_unique<ArraySource>(path, ReadNpz(path));
    }
    if (IsMatFile(first)) {
      return std::make_unique<ArraySource>(path, ReadMat(path));
    }
    RefuseOthers(path, first);
  }
  return std::make_unique<TextSource>(path);
}

}  // namespace armcal
