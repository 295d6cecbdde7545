#include "calib/gap_null.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "calib/gap_inflation.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kDraws = 200;
constexpr double kQuantile = .99;
constexpr double kRounding = 1e-9;  // of a score

// Gradients of the screen's columns with each block of the residual alone.
MatrixXd BlockGradients(const GapScreen& screen, const GapRows& rows,
                        const GapScreen::Fit& fit) {
  const int n = rows.num_joints();
  std::map<std::pair<int, long>, JointRows> blocks;
  for (int j = 0; j < n; ++j) {
    const std::vector<GapRows::Place> places = rows.PlacesOfRows(j);
    const VectorXd residual = screen.Residual(j, fit);
    for (size_t k = 0; k < places.size(); ++k) {
      JointRows& part =
          blocks.emplace(BlockOf(places[k]), JointRows(n)).first->second;
      for (int i = 0; i < n && part[i].size() == 0; ++i) {
        part[i] = VectorXd::Zero(screen.num_rows(i));
      }
      part[j][k] = residual[k];
    }
  }
  MatrixXd gradients(screen.size(), blocks.size());
  int at = 0;
  for (const auto& [place, part] : blocks) {
    gradients.col(at++) = screen.Gradient(part);
  }
  return gradients;
}

}  // namespace

double ScoreByChance(const GapScreen& screen, const GapRows& rows,
                     const std::vector<GapCandidate>& candidates,
                     const SelectionOptions& options,
                     const std::vector<int>& chosen, std::uint64_t seed) {
  const MatrixXd blocks =
      BlockGradients(screen, rows, screen.Solve(ColumnsOf(candidates, chosen)));
  std::mt19937_64 random(seed);
  std::vector<double> best;
  for (int draw = 0; draw < kDraws; ++draw) {
    VectorXd g = VectorXd::Zero(screen.size());
    for (Eigen::Index b = 0; b < blocks.cols(); ++b) {
      g += (random() & 1 ? 1. : -1.) * blocks.col(b);
    }
    best.push_back(
        ScoresBeside(screen, candidates, options, chosen, g).maxCoeff());
  }
  const auto nth = best.begin() + static_cast<int>(kQuantile * kDraws);
  std::nth_element(best.begin(), nth, best.end());
  return *nth;
}

Selection WithoutChance(const GapScreen& screen, const GapRows& rows,
                        const std::vector<GapCandidate>& candidates,
                        const SelectionOptions& options, Selection selection,
                        std::uint64_t seed) {
  while (!selection.chosen.empty()) {
    const GapScreen::Fit fit =
        screen.Solve(ColumnsOf(candidates, selection.chosen));
    int weakest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < static_cast<int>(selection.chosen.size()); ++k) {
      const GapCandidate& candidate = candidates[selection.chosen[k]];
      const double deflated =
          selection.drops[k] / Inflation(screen, rows, candidate, fit) -
          Price(screen, candidate);
      const double by_chance =
          ScoreByChance(screen, rows, candidates, options,
                        Without(selection.chosen, k), seed);
      const double margin =
          std::min(deflated - options.threshold,
                   selection.scores[k] * (1 + kRounding) - by_chance);
      if (margin < least) least = margin, weakest = k;
    }
    if (least >= 0) break;
    selection = DescribeSelection(screen, candidates, options,
                                  Without(selection.chosen, weakest));
  }
  return selection;
}

}  // namespace armcal
