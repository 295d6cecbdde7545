#pragma once

#include <zlib.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace armcal {

// What a zlib stream unpacks to, a block at a time.
class InflatedBytes {
 public:
  // `next` gives the next packed bytes, none at the end.
  explicit InflatedBytes(std::function<std::string()> next);
  ~InflatedBytes();
  InflatedBytes(const InflatedBytes&) = delete;
  InflatedBytes& operator=(const InflatedBytes&) = delete;

  // Passes over them where `to` is null. False where the stream is damaged or
  // ends before.
  bool Read(char* to, std::uint64_t count);
  // Whether the rest of the stream is whole.
  bool End();

 private:
  bool Fill();

  std::function<std::string()> next_;
  z_stream stream_{};
  std::string in_;
  std::vector<char> out_;
  size_t begin_ = 0, end_ = 0;  // what of out_ is yet to be read
  int code_ = Z_OK;
};

}  // namespace armcal
