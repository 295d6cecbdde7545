#include "calib/diagnose/data/baseline_columns.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace armcal {

Eigen::VectorXd BaselineColumns::Column(int column) const {
  const auto at = std::lower_bound(which.begin(), which.end(), column);
  if (at == which.end() || *at != column) return {};
  return values.col(at - which.begin());
}

Eigen::MatrixXd BaselineColumns::Select(const std::vector<int>& columns) const {
  Eigen::MatrixXd selected =
      Eigen::MatrixXd::Zero(values.rows(), columns.size());
  for (size_t k = 0; k < columns.size(); ++k) {
    const Eigen::VectorXd column = Column(columns[k]);
    if (column.size() > 0) selected.col(k) = column;
  }
  return selected;
}

void BaselineColumns::KeepFirst(int columns) {
  const auto end = std::lower_bound(which.begin(), which.end(), columns);
  which.erase(end, which.end());
  values.conservativeResize(values.rows(), which.size());
}

void BaselineColumns::Remove(int column) {
  const auto at = std::lower_bound(which.begin(), which.end(), column);
  if (at == which.end() || *at != column) return;
  std::vector<int> kept;
  for (int k = 0; k < static_cast<int>(which.size()); ++k) {
    if (which[k] != column) kept.push_back(k);
  }
  values = Eigen::MatrixXd(values(Eigen::all, kept));
  which.erase(at);
}

void BaselineColumns::Insert(int column, const Eigen::VectorXd& more) {
  const auto at = std::lower_bound(which.begin(), which.end(), column);
  const Eigen::Index place = at - which.begin(), after = which.end() - at;
  Eigen::MatrixXd all(more.size(), place + 1 + after);
  all << values.leftCols(place), more, values.rightCols(after);
  values = std::move(all);
  which.insert(at, column);
}

std::vector<BaselineColumns> OnEachJoint(std::vector<Eigen::MatrixXd> values) {
  std::vector<BaselineColumns> joints;
  for (Eigen::MatrixXd& one : values) {
    joints.emplace_back();
    joints.back().which.resize(one.cols());
    std::iota(joints.back().which.begin(), joints.back().which.end(), 0);
    joints.back().values = std::move(one);
  }
  return joints;
}

}  // namespace armcal
