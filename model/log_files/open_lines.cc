#include "model/log_files/open_lines.h"

#include <filesystem>
#include <string_view>

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

// A format that is not read, told by its first bytes, and what to do about it.
struct ForeignFormat {
  std::string_view begins;
  const char* advice;
};

void RefuseOthers(const std::string& path, const std::string& first) {
  static const ForeignFormat kForeign[] = {
      {"\x93NUMPY",
       "is a single NumPy array, whose columns have no names: save all arrays "
       "by name with numpy.savez"},
      {"\x89HDF\r\n\x1a\n",
       "is an HDF5 file, of which MATLAB's alone are read: open it with h5py "
       "and save its arrays by name with numpy.savez"},
      {"ARROW1",
       "is an Arrow (Feather) file: read it with pandas.read_feather and write "
       "it with to_csv"},
      {"ULog\x01\x12\x35",
       "is a ULog of PX4: `ulog2csv` makes CSV of its topics"},
      {"\xfd"
       "7zXZ",
       "is packed by xz: unpack it, or pack it with gzip"},
      {"7z\xbc\xaf", "is packed by 7-Zip: unpack it, or pack it with gzip"},
      {"\xd0\xcf\x11\xe0",
       "is a workbook of Excel: save its sheet as CSV (UTF-8)"},
  };
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
  // A digit is between the two, how well it packs.
  if (first.rfind("BZh", 0) == 0 && first.find("1AY&SY") == 4) {
    throw InputError(path, "", "",
                     "is packed by bzip2: unpack it, or pack it with gzip");
  }
  for (const ForeignFormat& format : kForeign) {
    if (first.compare(0, format.begins.size(), format.begins) == 0) {
      throw InputError(path, "", "", format.advice);
    }
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
