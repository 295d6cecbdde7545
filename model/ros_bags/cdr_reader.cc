#include "model/ros_bags/cdr_reader.h"

#include <algorithm>
#include <cstring>

namespace armcal {
namespace {

constexpr size_t kHeader = 4;

std::string Plural(std::uint64_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

CdrReader::CdrReader(std::string_view message) {
  if (message.size() < kHeader) {
    throw CdrError("has " + Plural(message.size(), "byte"));
  }
  // Of XCDR2 and of parameter lists ROS 2 makes no use.
  if (message[0] != 0 || static_cast<unsigned char>(message[1]) > 1) {
    throw CdrError("is not encoded as CDR (0 or 1), but as " +
                   std::to_string(static_cast<unsigned char>(message[0]) * 256 +
                                  static_cast<unsigned char>(message[1])));
  }
  big_ = message[1] == 0;
  bytes_ = message.substr(kHeader);
}

void CdrReader::Align(size_t size) { at_ = (at_ + size - 1) / size * size; }

std::uint64_t CdrReader::Take(size_t bytes) {
  Align(bytes);
  if (at_ > bytes_.size() || bytes > bytes_.size() - at_) {
    throw CdrError("ends after " + Plural(bytes_.size() + kHeader, "byte") +
                   ", in the middle of a value");
  }
  std::uint64_t value = 0;
  for (size_t k = 0; k < bytes; ++k) {
    const size_t place = big_ ? k : bytes - 1 - k;
    value = value << 8 | static_cast<unsigned char>(bytes_[at_ + place]);
  }
  at_ += bytes;
  return value;
}

std::uint32_t CdrReader::Unsigned() {
  return static_cast<std::uint32_t>(Take(4));
}

std::uint32_t CdrReader::Length(size_t item) {
  const std::uint32_t count = Unsigned();
  if (count > (bytes_.size() - at_) / item) {
    throw CdrError("says that " + Plural(count, "value") + " follow, and " +
                   Plural(bytes_.size() - at_, "byte") + " do");
  }
  return count;
}

std::string_view CdrReader::Text() {
  const std::uint32_t count = Length(1);
  const std::string_view text = bytes_.substr(at_, count);
  at_ += count;
  // With a final 0; some leave it out where there is nothing before it.
  if (!text.empty() && text.back() != '\0') {
    throw CdrError("holds a text without its end");
  }
  return text.substr(0, text.empty() ? 0 : count - 1);
}

std::string_view CdrReader::Texts(std::vector<std::string_view>* texts) {
  const size_t begin = at_;
  texts->resize(Length(4));
  for (std::string_view& text : *texts) text = Text();
  return bytes_.substr(begin, at_ - begin);
}

double CdrReader::Double() {
  const std::uint64_t bits = Take(8);
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void CdrReader::Doubles(std::vector<double>* values) {
  const std::uint32_t count = Unsigned();
  values->clear();
  if (count == 0) return;
  Align(8);
  if (at_ > bytes_.size() || count > (bytes_.size() - at_) / 8) {
    throw CdrError(
        "says that " + Plural(count, "number") + " follow, and " +
        Plural(bytes_.size() - std::min(at_, bytes_.size()), "byte") + " do");
  }
  values->resize(count);
  for (double& value : *values) value = Double();
}

void CdrReader::End() const {
  if (bytes_.size() - at_ < 8) return;
  throw CdrError("has " + Plural(bytes_.size() - at_, "byte") + " too many");
}

}  // namespace armcal
