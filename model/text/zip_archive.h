#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace armcal {

// A file inside a zip archive.
struct ZipEntry {
  std::string name;
  int method = 0;  // 0 stored, 8 deflated
  std::uint32_t crc = 0;
  std::uint64_t compressed = 0, size = 0;  // bytes
  std::uint64_t header = 0;                // where its local header begins
};

// Reads whole files out of a zip archive: stored or deflated, also zip64, as
// NumPy writes them. Sizes are those of the central directory, and checksums
// are checked. Throws InputError for damage, encryption, other methods and
// for archives that unpack to far more than logs do.
class ZipArchive {
 public:
  explicit ZipArchive(const std::string& path);

  const std::vector<ZipEntry>& entries() const { return entries_; }
  std::string Read(const ZipEntry& entry) const;

 private:
  std::string Bytes(std::uint64_t begin, std::uint64_t size) const;
  void ReadDirectory(std::uint64_t begin, std::uint64_t size,
                     std::uint64_t count);
  void CheckSizes() const;
  [[noreturn]] void Refuse(const std::string& why) const;

  std::string path_;
  std::uint64_t size_ = 0;
  std::vector<ZipEntry> entries_;
};

}  // namespace armcal
