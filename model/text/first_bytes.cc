#include "model/text/first_bytes.h"

#include <fstream>

namespace armcal {

std::string FirstBytes(const std::string& path) {
  std::string bytes(24, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(file.gcount()));
  return bytes;
}

}  // namespace armcal
