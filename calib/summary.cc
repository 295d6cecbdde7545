#include "calib/summary.h"

#include <filesystem>
#include <fstream>

#include "model/text/input_error.h"

namespace armcal {

std::ostream& operator<<(std::ostream& stream, const Summary& summary) {
  return stream << summary.report;
}

void WriteFiles(const Summary& summary, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const ResultFile& file : summary.files) {
    const std::filesystem::path path =
        std::filesystem::path(folder) / file.name;
    std::ofstream stream(path, std::ios::binary);
    stream << file.content;
    stream.close();
    if (stream) continue;
    throw InputError(path.string(), "", "", "cannot be written");
  }
}

}  // namespace armcal
