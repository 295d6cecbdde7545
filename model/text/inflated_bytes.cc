#include "model/text/inflated_bytes.h"

#include <algorithm>
#include <utility>

namespace armcal {

InflatedBytes::InflatedBytes(std::function<std::string()> next)
    : next_(std::move(next)), out_(1 << 18) {
  code_ = inflateInit(&stream_);
}

InflatedBytes::~InflatedBytes() { inflateEnd(&stream_); }

bool InflatedBytes::Read(char* to, std::uint64_t count) {
  while (count > 0) {
    if (begin_ == end_ && !Fill()) return false;
    const std::uint64_t part = std::min<std::uint64_t>(count, end_ - begin_);
    if (to != nullptr) to = std::copy_n(&out_[begin_], part, to);
    begin_ += part;
    count -= part;
  }
  return true;
}

bool InflatedBytes::End() {
  while (Fill()) continue;
  return code_ == Z_STREAM_END;
}

// The next block; false at the end, and where the stream is damaged.
bool InflatedBytes::Fill() {
  begin_ = end_ = 0;
  while (end_ == 0 && code_ == Z_OK) {
    if (stream_.avail_in == 0) {
      in_ = next_();
      stream_.next_in = reinterpret_cast<Bytef*>(in_.data());
      stream_.avail_in = static_cast<uInt>(in_.size());
    }
    stream_.next_out = reinterpret_cast<Bytef*>(out_.data());
    stream_.avail_out = static_cast<uInt>(out_.size());
    code_ = inflate(&stream_, Z_NO_FLUSH);
    end_ = out_.size() - stream_.avail_out;
  }
  return end_ > 0;
}

}  // namespace armcal
