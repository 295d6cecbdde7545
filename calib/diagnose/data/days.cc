#include "calib/diagnose/data/days.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace armcal {

std::vector<int> DayColumns(const GapBaseline& baseline) {
  std::vector<int> columns;
  for (int c = 0; c < baseline.size(); ++c) {
    if (baseline.columns()[c].kind == BaselineColumn::Kind::kDay) {
      columns.push_back(c);
    }
  }
  return columns;
}

bool IsAnotherDay(const GapBaseline& baseline, const Eigen::VectorXd& x,
                  const Eigen::MatrixXd& covariance) {
  constexpr double kClear = 5;  // standard deviations
  constexpr int kSeveral = 3;
  std::set<int> changed;
  for (const int c : DayColumns(baseline)) {
    if (std::abs(x[c]) > kClear * std::sqrt(covariance(c, c))) {
      changed.insert(baseline.columns()[c].joint);
    }
  }
  return static_cast<int>(changed.size()) >=
         std::min(kSeveral, baseline.robot().num_joints());
}

}  // namespace armcal
