#include "model/log_files/mat_elements.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <vector>

#include "model/text/inflated_bytes.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr std::uint32_t kMatrix = 14, kCompressed = 15;

// The next bytes of an element; null: they are passed over.
using ReadBytes = std::function<void(char* to, std::uint64_t count)>;

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
    std::uint64_t at = 128;
    while (at < size_) {
      const std::uint32_t type = Number(at), bytes = Number(at + 4);
      at += 8;
      if (type != kMatrix && type != kCompressed) Refuse("is damaged");
      if (bytes > size_ - at) Refuse("is cut off");
      if (type == kCompressed) {
        std::uint64_t from = at;
        const std::uint64_t end = at + bytes;
        InflatedBytes inflated([this, &from, end] {
          constexpr std::uint64_t kBlock = 1 << 16;
          std::string block(std::min(end - from, kBlock), '\0');
          Read(from, block.data(), block.size());
          from += block.size();
          return block;
        });
        CheckPacked(&inflated);
      } else {
        std::uint64_t from = at;
        CheckMatrix(
            [this, &from](char* to, std::uint64_t count) {
              if (to != nullptr) Read(from, to, count);
              from += count;
            },
            bytes, 0);
      }
      at += bytes;
    }
  }

  void CheckPacked(InflatedBytes* inflated) {
    const auto read = [this, inflated](char* to, std::uint64_t count) {
      if (!inflated->Read(to, count)) Refuse("is damaged");
    };
    const Tag tag = ReadTag(read);
    if (tag.type == kMatrix) CheckMatrix(read, tag.bytes, 0);
    if (!inflated->End()) Refuse("is damaged");
  }

  // That a matrix of numbers, or of cells or fields with such, has as many of
  // them as its dimensions say: matio leaves the others as the memory was.
  void CheckMatrix(const ReadBytes& read, std::uint64_t left, int depth) {
    constexpr int kCells = 1, kStructure = 2, kDoubles = 6, kMost = 15;
    constexpr int kDeepest = 16;  // no log has more; matio goes on
    if (left < 16 || depth > kDeepest) return Skip(read, left);
    const std::string flags = Take(read, &left);
    const int kind = flags.size() == 8 ? flags[swapped_ ? 3 : 0] : 0;
    const bool nested = kind == kCells || kind == kStructure;
    if (!nested && (kind < kDoubles || kind > kMost)) return Skip(read, left);
    const std::string sizes = Take(read, &left), name = Take(read, &left);
    if (nested) {
      while (left >= 8) {
        const Tag tag = ReadTag(read);
        left -= 8;
        const std::uint64_t bytes = std::min<std::uint64_t>(tag.size(), left);
        if (tag.type == kMatrix) {
          CheckMatrix(read, bytes, depth + 1);
        } else {
          Skip(read, bytes);
        }
        left -= bytes;
      }
      return Skip(read, left);
    }
    std::uint64_t count = 1;
    for (size_t k = 0; k + 4 <= sizes.size(); k += 4) {
      count *= NumberIn(sizes.data() + k);
    }
    CheckNumbers(read, name, count, left);
  }

  void CheckNumbers(const ReadBytes& read, const std::string& name,
                    std::uint64_t count, std::uint64_t left) {
    constexpr std::array<int, 14> kWidths = {0, 1, 1, 2, 2, 4, 4,
                                             4, 0, 8, 0, 0, 8, 8};
    if (count == 0 || left < 8) return Skip(read, left);
    const Tag tag = ReadTag(read);
    const int width = tag.type < kWidths.size() ? kWidths[tag.type] : 0;
    if (width == 0 || tag.bytes / width != count || tag.size() > left - 8) {
      throw InputError(path_, "variable " + OneLine(name),
                       std::to_string(tag.bytes) + " bytes",
                       "expected " + std::to_string(count) +
                           " numbers, as its dimensions say");
    }
    Skip(read, left - 8);
  }

  // The type and size of an element. A small one has up to 4 bytes, in the tag.
  struct Tag {
    std::uint32_t type = 0, bytes = 0;
    std::array<char, 4> small{};
    bool is_small = false;
    // With what fills it up.
    std::uint64_t size() const {
      return is_small ? 0 : (std::uint64_t{bytes} + 7) / 8 * 8;
    }
  };

  Tag ReadTag(const ReadBytes& read) const {
    std::array<char, 8> b;
    read(b.data(), b.size());
    Tag tag{NumberIn(b.data()), NumberIn(b.data() + 4), {}, false};
    if (tag.type >> 16 != 0) {
      tag.is_small = true;
      tag.bytes = std::min<std::uint32_t>(tag.type >> 16, 4);
      tag.type &= 0xffff;
      std::copy_n(b.data() + 4, 4, tag.small.data());
    }
    return tag;
  }

  // A small part of a matrix: flags, dimensions, name.
  std::string Take(const ReadBytes& read, std::uint64_t* left) const {
    constexpr std::uint32_t kMostBytes = 1 << 16;
    if (*left < 8) Refuse("is damaged");
    const Tag tag = ReadTag(read);
    *left -= 8;
    if (tag.size() > *left || tag.bytes > kMostBytes) Refuse("is damaged");
    *left -= tag.size();
    std::string bytes(tag.small.data(), tag.small.size());
    if (!tag.is_small) {
      bytes.resize(tag.size());
      read(bytes.data(), bytes.size());
    }
    bytes.resize(tag.bytes);
    return bytes;
  }

  static void Skip(const ReadBytes& read, std::uint64_t count) {
    if (count > 0) read(nullptr, count);
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

  std::uint32_t NumberIn(const char* bytes) const {
    std::array<unsigned char, 4> b;
    std::memcpy(b.data(), bytes, b.size());
    if (swapped_) std::reverse(b.begin(), b.end());
    return b[0] | b[1] << 8 | b[2] << 16 | std::uint32_t{b[3]} << 24;
  }

  std::uint32_t Number(std::uint64_t at) {
    std::array<char, 4> bytes;
    Read(at, bytes.data(), bytes.size());
    return NumberIn(bytes.data());
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
