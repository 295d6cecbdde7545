#pragma once

#include <string>
#include <vector>

namespace armcal {

// An array of NumPy's .npy format, versions 1 to 3, of one or two dimensions.
class NpyArray {
 public:
  // `name` and `file` are for messages. Throws InputError where the header is
  // damaged or the bytes are too few.
  NpyArray(const std::string& file, const std::string& name, std::string bytes);

  // Whether it holds real numbers or texts that can be used: little-endian
  // floats or integers, or texts of Python, in one or two dimensions.
  bool numeric() const { return kind_ == 'f' || kind_ == 'i' || kind_ == 'u'; }
  bool text() const { return kind_ == 'U' && shape_.size() == 1; }
  long rows() const { return shape_.empty() ? 0 : shape_[0]; }
  long columns() const { return shape_.size() < 2 ? 1 : shape_[1]; }
  // As many digits as bring the same number back.
  void AppendNumber(long row, long column, std::string* line) const;
  std::string Text(long row) const;  // UTF-8

 private:
  void ReadHeader(const std::string& header);
  [[noreturn]] void Refuse(const std::string& why) const;

  std::string file_, name_, bytes_;
  size_t begin_ = 0;  // of the data
  char kind_ = 0;     // f, i, u, U; 0: something else
  int item_ = 0;      // bytes
  bool fortran_ = false;
  std::vector<long> shape_;
};

}  // namespace armcal
