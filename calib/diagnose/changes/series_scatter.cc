#include "calib/diagnose/changes/series_scatter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/diagnose/data/day_shares.h"

namespace armcal {
namespace {

// Scatter that is usual, relative to the joint's torque: what models lack as a
// rule is a per cent or less of it (discrepancy.h).
constexpr double kUsualScatter = .005;

const std::pair<JointTerm, double> kFrictions[] = {kShareOfDays[0],
                                                   kShareOfDays[1]};

}  // namespace

using Eigen::VectorXd;

VectorXd FrictionDirection(const LogSeries& series, const VectorXd& level,
                           JointTerm term) {
  VectorXd direction = VectorXd::Zero(level.size());
  for (int j = 0; j < series.parameters.num_joints(); ++j) {
    const int k = series.TermIndex(j, term);
    if (k >= 0) {
      direction[k] = std::max(0., level[k]) / series.torque[k];
    }
  }
  return direction;
}

std::vector<ScatterComponent> MakeScatter(const LogSeries& series,
                                          const VectorXd& level) {
  const Eigen::Index size = series.pooled.size();
  std::vector<ScatterComponent> components;
  for (Eigen::Index k = 0; k < size; ++k) {
    components.push_back({VectorXd::Unit(size, k), kUsualScatter});
  }
  for (const auto& [term, share] : kFrictions) {
    for (int j = 0; j < series.parameters.num_joints(); ++j) {
      const int k = series.TermIndex(j, term);
      if (k < 0) continue;
      components[k].is_friction = true;
      components[k].usual = std::max(
          kUsualScatter, share * std::abs(level[k]) / series.torque[k]);
    }
    components.push_back({FrictionDirection(series, level, term), share, true});
  }
  return components;
}

}  // namespace armcal
