#include "model/torque_samples.h"

#include <algorithm>

namespace armcal {

void TorqueSampleWindow::Clear() {
  samples_.clear();
  appended_ = 0;
}

void TorqueSampleWindow::Append(const Log& block, int row) {
  const double t = block.t[row];
  if (appended_ == 0) begin_ = t;
  const double place =
      uniform_ ? static_cast<double>(appended_) : (t - begin_) / dt_;
  samples_.push_back({block.first_row + row, t, place, block.tau.row(row)});
  ++appended_;
}

void TorqueSampleWindow::DropBefore(long index) {
  while (!samples_.empty() &&
         samples_.front().place < static_cast<double>(index)) {
    samples_.pop_front();
  }
}

TorqueSamples TorqueSampleWindow::Between(long begin, long end) const {
  const auto at = [this](long index) {
    return std::lower_bound(
        samples_.begin(), samples_.end(), static_cast<double>(index),
        [](const Sample& s, double place) { return s.place < place; });
  };
  const auto first = at(begin), last = at(end);
  const Eigen::Index n = last - first;
  TorqueSamples result;
  result.t.resize(n);
  result.place.resize(n);
  result.tau.resize(n, n > 0 ? first->tau.size() : 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Sample& s = *(first + k);
    result.row.push_back(s.row);
    result.t[k] = s.t;
    result.place[k] = s.place - static_cast<double>(begin);
    result.tau.row(k) = s.tau;
  }
  return result;
}

void ReplaceOutliers(const std::vector<TorqueOutlier>& outliers, Log* block) {
  const auto at = [&outliers](long row) {
    return std::lower_bound(
        outliers.begin(), outliers.end(), row,
        [](const TorqueOutlier& o, long value) { return o.row < value; });
  };
  const auto end = at(block->first_row + block->size());
  for (auto o = at(block->first_row); o != end; ++o) {
    block->tau(o->row - block->first_row, o->joint) = o->replacement;
  }
}

}  // namespace armcal
