#include "model/line_source.h"

#include <array>
#include <filesystem>
#include <fstream>

#include "model/npz_source.h"
#include "model/text_source.h"

namespace armcal {

std::unique_ptr<LineSource> OpenLines(const std::string& path) {
  std::error_code error;
  // A pipe would lose what is looked at.
  if (std::filesystem::is_regular_file(path, error)) {
    std::array<char, 4> first{};
    std::ifstream(path, std::ios::binary).read(first.data(), first.size());
    if (first == std::array<char, 4>{'P', 'K', 3, 4}) {
      return std::make_unique<NpzSource>(path);
    }
  }
  return std::make_unique<TextSource>(path);
}

}  // namespace armcal
