#include "model/ros_bags/mcap_bag.h"

#include <zlib.h>

#include <algorithm>
#include <filesystem>

#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/unpack.h"

namespace armcal {
namespace {

// Opcodes of records.
constexpr int kFooter = 0x02, kSchema = 0x03, kChannel = 0x04, kMessage = 0x05,
              kChunk = 0x06, kDataEnd = 0x0f;
constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr size_t kRecordHeader = 9;  // the opcode, the length
// Of a record: recorders make chunks of 1 to 4 MB.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;

class TooShort {};

// The fields of a record in their order, little-endian. Throws TooShort.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : rest_(bytes) {}

  std::uint64_t Number(size_t bytes) {
    const std::string_view field = Take(bytes);
    std::uint64_t value = 0;
    for (size_t k = bytes; k-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(field[k]);
    }
    return value;
  }
  std::string Text() { return std::string(Take(Number(4))); }
  std::string_view Bytes() { return Take(Number(8)); }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view Take(std::uint64_t bytes) {
    if (bytes > rest_.size()) throw TooShort();
    const std::string_view field = rest_.substr(0, bytes);
    rest_.remove_prefix(bytes);
    return field;
  }

  std::string_view rest_;
};

}  // namespace

bool IsMcap(std::string_view first_bytes) {
  return first_bytes.substr(0, kMagic.size()) == kMagic;
}

McapBag::McapBag(const std::string& path, const Wanted& wanted)
    : path_(path), wanted_(wanted), file_(path, std::ios::binary) {
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error || !file_) throw InputError(path, "", "", "cannot be read");
  at_ = kMagic.size();
  file_.seekg(static_cast<std::streamoff>(at_));
}

bool McapBag::Next(BagMessage* message) {
  int opcode;
  std::string_view content;
  try {
    while (NextRecord(&opcode, &content)) {
      if (opcode == kSchema) {
        Fields fields(content);
        const int id = static_cast<int>(fields.Number(2));
        schemas_[id] = fields.Text();
      } else if (opcode == kChannel) {
        AddChannel(content);
      } else if (opcode == kChunk) {
        OpenChunk(content);
      } else if (ReadMessage(content, message)) {
        return true;
      }
    }
  } catch (const TooShort&) {
    Refuse("is damaged: a record is too short");
  }
  return false;
}

bool McapBag::NextRecord(int* opcode, std::string_view* content) {
  while (chunk_at_ < chunk_.size()) {
    if (NextInChunk(opcode, content)) return true;
  }
  return NextInFile(opcode, content);
}

bool McapBag::NextInChunk(int* opcode, std::string_view* content) {
  Fields fields(std::string_view(chunk_).substr(chunk_at_));
  *opcode = static_cast<int>(fields.Number(1));
  *content = fields.Bytes();
  chunk_at_ = chunk_.size() - fields.rest().size();
  return *opcode == kSchema || *opcode == kChannel || *opcode == kMessage;
}

bool McapBag::NextInFile(int* opcode, std::string_view* content) {
  while (true) {
    const std::uint64_t left = size_ - at_;
    record_.resize(kRecordHeader);
    if (left < kRecordHeader || !file_.read(record_.data(), kRecordHeader)) {
      Refuse("is cut off");
    }
    Fields fields(record_);
    *opcode = static_cast<int>(fields.Number(1));
    const std::uint64_t bytes = fields.Number(8);
    if (*opcode == kDataEnd || *opcode == kFooter) return false;
    if (bytes > left - kRecordHeader) Refuse("is cut off");
    at_ += kRecordHeader + bytes;
    if (*opcode < kSchema || *opcode > kChunk) {
      file_.seekg(static_cast<std::streamoff>(at_));
      continue;
    }
    if (bytes > kMostBytes) Refuse("has a record of more than 1 GB");
    record_.resize(bytes);
    if (!file_.read(record_.data(), static_cast<std::streamsize>(bytes))) {
      Refuse("cannot be read");
    }
    *content = record_;
    return true;
  }
}

void McapBag::OpenChunk(std::string_view content) {
  Fields fields(content);
  fields.Number(8);  // first time
  fields.Number(8);  // last time
  const std::uint64_t size = fields.Number(8);
  const auto checksum = static_cast<std::uint32_t>(fields.Number(4));
  const std::string method = fields.Text();
  const std::string_view packed = fields.Bytes();
  if (size > std::min(kMostBytes, MostUnpacked(packed.size()))) {
    Refuse("is damaged: a chunk says that its " +
           std::to_string(packed.size()) + " bytes unpack to " +
           std::to_string(size));
  }
  bool whole;
  if (method.empty()) {
    chunk_ = packed;
    whole = packed.size() == size;
  } else if (method == "zstd") {
    whole = UnpackZstd(packed, size, &chunk_);
  } else if (method == "lz4") {
    whole = UnpackLz4(packed, size, &chunk_);
  } else {
    throw InputError(path_, "byte " + std::to_string(at_), OneLine(method),
                     "expected chunks packed by zstd, lz4 or not at all; `mcap "
                     "compress` packs them anew");
  }
  if (!whole) Refuse("is damaged: a chunk cannot be unpacked");
  if (checksum != 0 &&
      checksum != crc32_z(0, reinterpret_cast<const Bytef*>(chunk_.data()),
                          chunk_.size())) {
    Refuse("is damaged: a chunk's checksum is wrong");
  }
  chunk_at_ = 0;
}

void McapBag::AddChannel(std::string_view content) {
  Fields fields(content);
  const int id = static_cast<int>(fields.Number(2));
  const int schema = static_cast<int>(fields.Number(2));
  const std::string name = fields.Text(), encoding = fields.Text();
  if (channels_.count(id) > 0) return;  // a chunk repeats what it needs
  if (schema != 0 && schemas_.count(schema) == 0) {
    Refuse("is damaged: topic " + OneLine(name) + " is of no schema");
  }
  topics_.push_back({name, schemas_[schema], encoding});
  channels_[id] = {&topics_.back(), wanted_(topics_.back())};
}

bool McapBag::ReadMessage(std::string_view content, BagMessage* message) const {
  Fields fields(content);
  const auto channel = channels_.find(static_cast<int>(fields.Number(2)));
  if (channel == channels_.end()) {
    Refuse("is damaged: a message is of no channel");
  }
  if (!channel->second.wanted) return false;
  fields.Number(4);  // its number
  message->topic = channel->second.topic;
  message->received = static_cast<std::int64_t>(fields.Number(8));
  fields.Number(8);  // when it was published
  message->data = fields.rest();
  return true;
}

std::vector<BagTopic> McapBag::Topics() const {
  return {topics_.begin(), topics_.end()};
}

void McapBag::Refuse(const std::string& why) const {
  throw InputError(path_, "byte " + std::to_string(at_), "",
                   why + "; `mcap recover` saves what is whole");
}

}  // namespace armcal
