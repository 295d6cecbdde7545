#include "calib/poses/effects/order/order_signals.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/Splines>

namespace armcal {
namespace {

// Poses that a step or a window needs on each side, to be more than an outlier.
constexpr int kLeastBlock = 3;
// A grid finer than what a search refines from costs time alone.
constexpr int kStepsOfGrid = 24, kWindowsOfGrid = 12;
// Poses per knot, at least: else a drift follows each pose.
constexpr int kPosesPerKnot = 5;

std::vector<int> OrderGrid(int poses, int cells) {
  std::vector<int> grid;
  const double step =
      std::max(1.0, static_cast<double>(poses) / static_cast<double>(cells));
  for (double at = kLeastBlock; at <= poses - kLeastBlock; at += step) {
    grid.push_back(static_cast<int>(std::lround(at)));
  }
  return grid;
}

}  // namespace

std::vector<PosePlace> StepPlaces(const PoseCampaign& campaign,
                                  const std::vector<int>& parts) {
  std::vector<PosePlace> places;
  for (const int part : parts) {
    for (const int begin : OrderGrid(campaign.size(), kStepsOfGrid)) {
      PosePlace place;
      place.parts = part;
      place.begin = begin;
      places.push_back(place);
    }
  }
  return places;
}

std::vector<PosePlace> WindowPlaces(const PoseCampaign& campaign,
                                    const std::vector<int>& parts) {
  std::vector<PosePlace> places;
  const std::vector<int> grid = OrderGrid(campaign.size(), kWindowsOfGrid);
  for (const int part : parts) {
    for (const int begin : grid) {
      for (const int end : grid) {
        if (end - begin < kLeastBlock) continue;
        PosePlace place;
        place.parts = part;
        place.begin = begin;
        place.end = end;
        places.push_back(place);
      }
    }
  }
  return places;
}

double StepCount(const PoseCampaign& campaign) { return campaign.size(); }

double WindowCount(const PoseCampaign& campaign) {
  return .5 * campaign.size() * campaign.size();
}

std::vector<PosePlace> DriftPlaces(const PoseCampaign& campaign,
                                   const std::vector<int>& parts,
                                   const std::vector<int>& knots) {
  std::vector<PosePlace> places;
  for (const int part : parts) {
    for (const int count : knots) {
      if (count > 2 && kPosesPerKnot * count > campaign.size()) continue;
      PosePlace place;
      place.parts = part;
      place.knots = count;
      places.push_back(place);
    }
  }
  return places;
}

Eigen::VectorXd WindowSignal(int poses, const PosePlace& place) {
  Eigen::VectorXd signal = Eigen::VectorXd::Zero(poses);
  const int end = place.end < 0 ? poses : std::min(place.end, poses);
  signal.segment(place.begin, std::max(0, end - place.begin)).setOnes();
  return signal;
}

Eigen::MatrixXd DriftSignals(int poses, const PosePlace& place) {
  if (place.knots == 1) {
    return 1 - (-4 * Eigen::ArrayXd::LinSpaced(poses, 0, 1)).exp();
  }
  using Spline = Eigen::Spline<double, 1>;
  const int degree = std::min(3, place.knots - 1);
  const Eigen::RowVectorXd at =
      Eigen::RowVectorXd::LinSpaced(place.knots, 0, 1);
  Eigen::MatrixXd signals(poses, place.knots - 1);
  for (int c = 0; c + 1 < place.knots; ++c) {
    const Eigen::RowVectorXd one = Eigen::RowVectorXd::Unit(place.knots, c + 1);
    const Spline spline =
        Eigen::SplineFitting<Spline>::Interpolate(one, degree, at);
    for (int k = 0; k < poses; ++k) {
      signals(k, c) = spline(k / (poses - 1.0))[0];
    }
  }
  return signals;
}

std::vector<int> ToolParts(const PoseCampaign& campaign) {
  std::vector<int> parts = {3};
  if (campaign.ShowsRotation()) parts.push_back(6);
  for (int t = 0; campaign.targets > 1 && t < campaign.targets; ++t) {
    parts.push_back(-t - 1);
  }
  return parts;
}

std::vector<PoseTerm> MovedBody(PoseTerm::Acts acts, int parts,
                                const Eigen::MatrixXd& signals) {
  const int target = parts < 0 ? -parts - 1 : 0;
  std::vector<PoseTerm> terms;
  for (Eigen::Index c = 0; c < signals.cols(); ++c) {
    const std::string knot =
        signals.cols() > 1 ? " " + std::to_string(c + 1) : "";
    const int axes = acts == PoseTerm::Acts::kLength ? 1 : parts == 6 ? 6 : 3;
    for (int axis = 0; axis < axes; ++axis) {
      terms.push_back({parts < 0 ? PoseTerm::Acts::kTarget : acts,
                       3 * target + axis, signals.col(c),
                       axes == 1 ? "length" + knot
                                 : (axis > 2 ? "about " : "") +
                                       std::string(1, "xyz"[axis % 3]) + knot,
                       axis > 2 ? "rad" : "m"});
    }
  }
  return terms;
}

}  // namespace armcal
