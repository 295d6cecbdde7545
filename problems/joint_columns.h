#pragma once

#include <vector>

namespace armcal {

// Some rows or samples of every joint's columns, for kernels to write: column c
// of joint i begins at data()[i] + c * stride(). Used again it needs no memory
// again.
class JointColumns {
 public:
  // `sizes`: columns of each joint; `rows` of them at least, what is in them is
  // left over or 0.
  void Resize(const std::vector<int>& sizes, long rows);

  double* const* data() const { return joints_.data(); }
  long stride() const { return stride_; }
  double* column(int i, int c) const { return joints_[i] + c * stride_; }

 private:
  std::vector<double> room_;
  std::vector<double*> joints_;
  long stride_ = 0;
};

}  // namespace armcal
