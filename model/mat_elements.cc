#include "model/mat_elements.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "model/input_error.h"

namespace armcal {
namespace {

class MatFile {
 public:
  explicit MatFile(const std::string& path)
      : path_(path), file_(path, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(path, error);
    if (error || !file_) throw InputError(path, "", "", "cannot be read");
  }

  void Check() {
    std::array<char, 4> end{};  // of the header of v5: version, byte order
    if (size_ >= 128) Read(124, end.data(), end.size());
    const std::string_view order(end.data() + 2, 2);
    if (order != "IM" && order != "MI") return CheckV4();
    swapped_ = order == "MI";
    if (end[swapped_ ? 0 : 1] == 1) CheckV5();
  }

 private:
  // An element: its type, its bytes, both of 32 bits, and the bytes.
  void CheckV5() {
    constexpr std::uint32_t kMatrix = 14, kCompressed = 15;
    std::uint64_t at = 128;
    while (at < size_) {
      const std::uint32_t type = Number(at), bytes = Number(at + 4);
      at += 8;
      if (type != kMatrix && type != kCompressed) Refuse("is damaged");
      if (bytes > size_ - at) Refuse("is cut off");
      if (type == kCompressed) CheckCompressed(at, bytes);
      at += bytes;
    }
  }

  // Five numbers: type (thousands: byte order, tens: of the numbers), rows,
  // columns, whether there are imaginary parts, bytes of the name; then the
  // name and the numbers.
  void CheckV4() {
    constexpr std::array<int, 6> kWidths = {8, 4, 4, 2, 2, 1};
    std::uint64_t at = 0;
    while (at < size_) {
      swapped_ = false;
      swapped_ = Number(at) > 9999;
      const std::uint32_t type = Number(at), kind = type / 10 % 10;
      if (type > 9999 || kind >= kWidths.size()) Refuse("is damaged");
      const std::uint64_t rows = Number(at + 4), columns = Number(at + 8),
                          parts = Number(at + 12) == 0 ? 1 : 2,
                          name = Number(at + 16);
      at += 20;
      const std::uint64_t left = size_ - at;
      if (name > left || (columns > 0 && rows > left / columns) ||
          rows * columns * parts * kWidths[kind] > left - name) {
        Refuse("is cut off");
      }
      at += name + rows * columns * parts * kWidths[kind];
    }
  }

  void CheckCompressed(std::uint64_t at, std::uint64_t bytes) {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) Refuse("cannot be unpacked");
    std::vector<char> in(1 << 16), out(1 << 18);
    int code = Z_OK;
    while (code == Z_OK && bytes > 0) {
      const std::uint64_t count = std::min<std::uint64_t>(bytes, in.size());
      Read(at, in.data(), count);
      at += count;
      bytes -= count;
      stream.next_in = reinterpret_cast<Bytef*>(in.data());
      stream.avail_in = static_cast<uInt>(count);
      do {
        stream.next_out = reinterpret_cast<Bytef*>(out.data());
        stream.avail_out = static_cast<uInt>(out.size());
        code = inflate(&stream, Z_NO_FLUSH);
      } while (code == Z_OK && stream.avail_out == 0);
      if (code == Z_BUF_ERROR) code = Z_OK;  // wants more
    }
    inflateEnd(&stream);
    if (code != Z_STREAM_END) Refuse("is damaged");
  }

  std::uint32_t Number(std::uint64_t at) {
    std::array<unsigned char, 4> b;
    Read(at, reinterpret_cast<char*>(b.data()), b.size());
    if (swapped_) std::reverse(b.begin(), b.end());
    return b[0] | b[1] << 8 | b[2] << 16 | std::uint32_t{b[3]} << 24;
  }

  void Read(std::uint64_t at, char* to, std::uint64_t count) {
    file_.seekg(static_cast<std::streamoff>(at));
    if (!file_.read(to, static_cast<std::streamsize>(count))) {
      Refuse("is cut off");
    }
  }

  [[noreturn]] void Refuse(const std::string& why) const {
    throw InputError(path_, "", "", why + ": expected a whole MAT-file");
  }

  std::string path_;
  std::ifstream file_;
  std::uint64_t size_ = 0;
  bool swapped_ = false;  // the bytes of numbers
};

}  // namespace

void CheckMatElements(const std::string& path) { MatFile(path).Check(); }

}  // namespace armcal
