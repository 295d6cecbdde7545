#include "model/text/zip_archive.h"

#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/unpack.h"

namespace armcal {
namespace {

constexpr std::uint32_t kIn64 = std::numeric_limits<std::uint32_t>::max();

// A little-endian number of `count` bytes.
std::uint64_t Number(const std::string& bytes, size_t at, int count) {
  std::uint64_t value = 0;
  for (int k = count - 1; k >= 0; --k) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
  }
  return value;
}

// What zip64 keeps in the extra field, in place of 32 bits that are all set.
void ReadZip64(const std::string& extra, ZipEntry* entry) {
  for (size_t at = 0; at + 4 <= extra.size();) {
    const std::uint64_t size = Number(extra, at + 2, 2);
    if (Number(extra, at, 2) == 1) {
      size_t next = at + 4;
      const size_t end = std::min(extra.size(), next + size);
      for (std::uint64_t* value :
           {&entry->size, &entry->compressed, &entry->header}) {
        if (*value != kIn64 || next + 8 > end) continue;
        *value = Number(extra, next, 8);
        next += 8;
      }
      return;
    }
    at += 4 + size;
  }
}

// Whether `packed` is exactly a deflate stream of `text`'s size.
bool Inflate(const std::string& packed, std::string* text) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return false;
  constexpr std::uint64_t kStep = 1 << 30;
  std::uint64_t in = 0, out = 0;
  int code = Z_OK;
  while (code == Z_OK && (in < packed.size() || out < text->size())) {
    const auto give = std::min<std::uint64_t>(kStep, packed.size() - in);
    const auto take = std::min<std::uint64_t>(kStep, text->size() - out);
    stream.next_in =
        reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + in));
    stream.avail_in = static_cast<uInt>(give);
    stream.next_out = reinterpret_cast<Bytef*>(text->data() + out);
    stream.avail_out = static_cast<uInt>(take);
    code = inflate(&stream, Z_NO_FLUSH);
    in += give - stream.avail_in;
    out += take - stream.avail_out;
  }
  inflateEnd(&stream);
  return code == Z_STREAM_END && out == text->size();
}

std::uint32_t Checksum(const std::string& text) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

}  // namespace

ZipArchive::ZipArchive(const std::string& path) : path_(path) {
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error) throw InputError(path, "", "", "cannot be read");
  // The end record, before a comment of at most 65535 bytes.
  const std::uint64_t tail = std::min<std::uint64_t>(size_, 22 + 65535);
  const std::string end = Bytes(size_ - tail, tail);
  const size_t at = end.rfind("PK\5\6");
  if (at == end.npos || at + 22 > end.size()) {
    Refuse("is a zip archive without its directory: it was cut off");
  }
  std::uint64_t count = Number(end, at + 10, 2), size = Number(end, at + 12, 4),
                begin = Number(end, at + 16, 4);
  if (begin == kIn64 || count == 0xffff) {
    const size_t locator = end.rfind("PK\6\7");
    if (locator == end.npos || locator + 16 > end.size()) {
      Refuse("is a damaged zip archive");
    }
    const std::string record = Bytes(Number(end, locator + 8, 8), 56);
    count = Number(record, 32, 8);
    size = Number(record, 40, 8);
    begin = Number(record, 48, 8);
  }
  ReadDirectory(begin, size, count);
}

void ZipArchive::ReadDirectory(std::uint64_t begin, std::uint64_t size,
                               std::uint64_t count) {
  const std::string directory = Bytes(begin, size);
  size_t at = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    if (at + 46 > directory.size() || directory.compare(at, 4, "PK\1\2") != 0) {
      Refuse("is a damaged zip archive");
    }
    const size_t name = Number(directory, at + 28, 2),
                 extra = Number(directory, at + 30, 2),
                 comment = Number(directory, at + 32, 2);
    if (at + 46 + name + extra + comment > directory.size()) {
      Refuse("is a damaged zip archive");
    }
    if (Number(directory, at + 8, 2) & 1) Refuse("is encrypted");
    ZipEntry entry;
    entry.method = static_cast<int>(Number(directory, at + 10, 2));
    entry.crc = static_cast<std::uint32_t>(Number(directory, at + 16, 4));
    entry.compressed = Number(directory, at + 20, 4);
    entry.size = Number(directory, at + 24, 4);
    entry.header = Number(directory, at + 42, 4);
    entry.name = directory.substr(at + 46, name);
    ReadZip64(directory.substr(at + 46 + name, extra), &entry);
    entries_.push_back(entry);
    at += 46 + name + extra + comment;
  }
  CheckSizes();
}

void ZipArchive::CheckSizes() const {
  std::uint64_t left = MostUnpacked(size_);
  for (const ZipEntry& entry : entries_) {
    if (entry.size > left) {
      Refuse(
          "unpacks to more than 64 MiB and 200 times its size: expected a "
          "log, which does not pack that much");
    }
    left -= entry.size;
  }
}

std::string ZipArchive::Read(const ZipEntry& entry) const {
  const std::string name = OneLine(entry.name);
  // The local header's own names and sizes may be of other lengths.
  const std::string local = Bytes(entry.header, 30);
  const std::uint64_t begin =
      entry.header + 30 + Number(local, 26, 2) + Number(local, 28, 2);
  std::string packed = Bytes(begin, entry.compressed);
  if (entry.method != 0 && entry.method != 8) {
    Refuse("packs " + name + " by method " + std::to_string(entry.method) +
           "; expected stored or deflated, as numpy.savez writes");
  }
  std::string text;
  if (entry.method == 0) {
    text = std::move(packed);
  } else {
    text.resize(entry.size);
    if (!Inflate(packed, &text)) Refuse("is damaged in " + name);
  }
  if (text.size() != entry.size || Checksum(text) != entry.crc) {
    Refuse("is damaged in " + name + ": its checksum is wrong");
  }
  return text;
}

std::string ZipArchive::Bytes(std::uint64_t begin, std::uint64_t size) const {
  if (begin > size_ || size > size_ - begin) {
    Refuse("is a damaged zip archive: it ends too early");
  }
  std::string bytes(size, '\0');
  std::ifstream file(path_, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(begin));
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) {
    Refuse("cannot be read");
  }
  return bytes;
}

void ZipArchive::Refuse(const std::string& why) const {
  throw InputError(path_, "", "", why);
}

}  // namespace armcal
