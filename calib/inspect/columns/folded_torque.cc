#include "calib/inspect/columns/folded_torque.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kMovesOfRms = .2;  // as TorqueFit has it
constexpr double kNearOfRms = 1. / 30;
constexpr double kAway = 5;  // times as far
// Right columns of one sign of which one would be told. Of 26 in
// ../shared/data the only one that comes near zero does so once.
constexpr double kRightColumns = 100;
// So few visits are of no distribution.
constexpr int kFewVisits = 4;
// Between a fifth and its neighbours, 1/25 and sqrt(1/5): the geometric means.
constexpr double kLeastFoldShare = .09, kMostFoldShare = .3;

}  // namespace

bool Folds::HaveLostSign(int columns, int agree) const {
  return visits + agree > std::log2(kRightColumns * columns) &&
         visits > kFewVisits && share > kLeastFoldShare &&
         share < kMostFoldShare;
}

Folds FindFolds(const VectorXd& torque, const VectorXd& speed) {
  const double least =
      kMovesOfRms * speed.norm() / std::sqrt(static_cast<double>(speed.size()));
  const VectorXd moves = (speed.array().abs() > least).cast<double>().matrix();
  const double near = kNearOfRms * torque.cwiseProduct(moves).norm() /
                      std::sqrt(std::max(1., moves.sum()));
  Folds folds;
  double within = 0, close = 0;
  bool was_away = false;
  for (Eigen::Index k = 0; k < torque.size(); ++k) {
    if (moves[k] == 0) continue;
    const double x = std::abs(torque[k]);
    if (x < kAway * near) ++close;
    if (x >= kAway * near) was_away = true;
    if (!(x < near)) continue;
    ++within;
    folds.visits += was_away ? 1 : 0;
    was_away = false;
  }
  folds.share = close > 0 ? within / close : 0;
  return folds;
}

}  // namespace armcal
