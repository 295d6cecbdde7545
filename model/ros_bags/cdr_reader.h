#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace armcal {

// A message that is not what its type says.
class CdrError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Reads the numbers of a message of ROS 2 in their order (CDR, OMG formal
// 02-06-51, 15.3): aligned to their own size from the fifth byte on; the first
// four tell the byte order. Throws CdrError for other encapsulations and for a
// message that ends too early.
class CdrReader {
 public:
  explicit CdrReader(std::string_view message);

  std::uint32_t Unsigned();
  std::int32_t Signed() { return static_cast<std::int32_t>(Unsigned()); }
  double Double();
  std::string_view Text();                    // without its final 0
  void Doubles(std::vector<double>* values);  // a sequence
  // A sequence of texts; returns its bytes too, which tell equal ones.
  std::string_view Texts(std::vector<std::string_view>* texts);
  // The length of a sequence whose items have at least `item` bytes.
  std::uint32_t Length(size_t item);
  // Throws where more is left than what fills the last 8 bytes.
  void End() const;

 private:
  void Align(size_t size);
  std::uint64_t Take(size_t bytes);  // 4 or 8

  std::string_view bytes_;  // from the fifth on
  size_t at_ = 0;
  bool big_ = false;
};

}  // namespace armcal
