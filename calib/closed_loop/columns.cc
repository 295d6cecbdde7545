#include "calib/closed_loop/columns.h"

#include <glog/logging.h>

#include "model/dynamics/base_inertials.h"

namespace armcal {

// Of the links only base parameters get a column, since torques and so motions
// see no others (Gautier & Khalil 1990); `spread_` gives the rest their
// multiples.
LoopColumns::LoopColumns(const Robot& robot, const std::vector<bool>& free)
    : n_(robot.num_joints()) {
  const LoopOrder order(n_);
  CHECK_EQ(free.size(), static_cast<size_t>(order.size()));
  std::vector<int> value_of_column;
  Eigen::MatrixXd links;
  if (free[0]) {
    const BaseInertials base(robot);
    arm_.inertials = base.columns;
    links = base.combinations;
    value_of_column.assign(base.columns.begin(), base.columns.end());
  }
  const auto takes = [&](int value) {
    if (free[value]) value_of_column.push_back(value);
    return free[value];
  };
  for (int k = 0; k < 4 * n_; ++k) {
    if (takes(order.terms() + k))
      arm_.terms.push_back({k / 4, kLoopTerms[k % 4]});
  }
  for (int j = 0; j < n_; ++j) {
    if (takes(order.widths() + j)) arm_.terms.push_back({j, {}});
  }
  int value = order.gains();
  for (double DriveLaw::*gain : EstimatedGains()) {
    for (int j = 0; j < n_; ++j) {
      const int column = static_cast<int>(value_of_column.size());
      if (takes(value++)) gains_.push_back({j, gain, column});
    }
  }
  if (takes(order.delay())) {
    delay_ = static_cast<int>(value_of_column.size()) - 1;
  }
  num_values_ = static_cast<int>(value_of_column.size());
  spread_ = Eigen::MatrixXd::Zero(num_values_, order.size());
  for (int c = 0; c < num_values_; ++c) spread_(c, value_of_column[c]) = 1;
  spread_.topLeftCorner(links.rows(), links.cols()) = links;
}

}  // namespace armcal
