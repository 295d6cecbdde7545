#include "model/signals/torque_samples.h"

#include <algorithm>

namespace armcal {

void TorqueSampleWindow::Clear() {
  rows_.clear();
  times_.clear();
  places_.clear();
  for (std::vector<double>& column : tau_) column.clear();
  appended_ = 0;
}

void TorqueSampleWindow::Append(const Log& block, int row, int count) {
  if (appended_ == 0) begin_ = block.t[row];
  for (int k = row; k < row + count; ++k, ++appended_) {
    const double t = block.t[k];
    rows_.push_back(block.first_row + k);
    times_.push_back(t);
    places_.push_back(uniform_ ? static_cast<double>(appended_)
                               : (t - begin_) / dt_);
  }
  tau_.resize(block.tau.cols());
  for (size_t c = 0; c < tau_.size(); ++c) {
    const double* const x = block.tau.col(c).data() + row;
    tau_[c].insert(tau_[c].end(), x, x + count);
  }
}

long TorqueSampleWindow::At(long index) const {
  return std::lower_bound(places_.begin(), places_.end(),
                          static_cast<double>(index)) -
         places_.begin();
}

void TorqueSampleWindow::DropBefore(long index) {
  const long count = At(index);
  rows_.erase(rows_.begin(), rows_.begin() + count);
  times_.erase(times_.begin(), times_.begin() + count);
  places_.erase(places_.begin(), places_.begin() + count);
  for (std::vector<double>& column : tau_) {
    column.erase(column.begin(), column.begin() + count);
  }
}

TorqueSamples TorqueSampleWindow::Between(long begin, long end) const {
  const long first = At(begin), last = At(end);
  const Eigen::Index n = last - first;
  TorqueSamples result;
  result.row.assign(rows_.begin() + first, rows_.begin() + last);
  result.t = Eigen::Map<const Eigen::VectorXd>(times_.data() + first, n);
  result.place =
      Eigen::Map<const Eigen::VectorXd>(places_.data() + first, n).array() -
      static_cast<double>(begin);
  result.tau.resize(n, n > 0 ? static_cast<Eigen::Index>(tau_.size()) : 0);
  for (Eigen::Index c = 0; c < result.tau.cols(); ++c) {
    std::copy_n(tau_[c].data() + first, n, result.tau.col(c).data());
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
