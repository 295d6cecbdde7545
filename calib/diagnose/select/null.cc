#include "calib/diagnose/select/null.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/inflation.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kDraws = 200;
constexpr double kRounding = 1e-9;  // of a score
constexpr double kLowest = -100;    // of scores that no candidate has

// Gradients of the screen's columns with each block of the residual alone.
MatrixXd BlockGradients(const GapScreen& screen, const GapRows& rows,
                        const GapScreen::Fit& fit) {
  const int n = rows.num_joints();
  std::map<std::pair<int, long>, int> blocks;
  std::vector<std::vector<std::pair<int, long>>> of_row(n);
  JointRows residual(n);
  for (int j = 0; j < n; ++j) {
    residual[j] = screen.Residual(j, fit);
    for (const GapRows::Place& place : rows.PlacesOfRows(j)) {
      of_row[j].push_back(BlockOf(place));
      blocks[of_row[j].back()] = 0;
    }
  }
  int count = 0;
  for (auto& [block, number] : blocks) number = count++;
  std::vector<std::vector<int>> numbers(n);
  for (int j = 0; j < n; ++j) {
    for (const auto& block : of_row[j]) numbers[j].push_back(blocks[block]);
  }
  return screen.Gradients(residual, numbers, count);
}

// The order statistic that one more draw exceeds with a probability of 1 -
// share at most, as a Monte Carlo test asks for (Davison and Hinkley 1997,
// 4.2): a quantile between two draws would be below it.
double OrderStatistic(VectorXd x, double share) {
  const auto nth = x.begin() + static_cast<int>(share * x.size());
  std::nth_element(x.begin(), nth, x.end());
  return *nth;
}

// Scores of one place over the draws, in units of their own upper tail: what
// the form of an effect leaves on one joint says nothing of another.
struct PlaceExcess {
  double median, scale;
  VectorXd deviations;
};

PlaceExcess Excess(const VectorXd& scores) {
  PlaceExcess excess;
  excess.median = OrderStatistic(scores, .5);
  excess.scale = std::max(1., OrderStatistic(scores, .9) - excess.median);
  excess.deviations = (scores.array() - excess.median) / excess.scale;
  return excess;
}

}  // namespace

double ScoreByChance(const GapScreen& screen, const GapRows& rows,
                     const std::vector<GapCandidate>& candidates,
                     const SelectionOptions& options,
                     const std::vector<int>& chosen, int joint,
                     std::uint64_t seed) {
  const MatrixXd blocks =
      BlockGradients(screen, rows, screen.Solve(ColumnsOf(candidates, chosen)));
  std::mt19937_64 random(seed);
  // Of the whole robot, and of each joint.
  MatrixXd best = MatrixXd::Constant(kDraws, rows.num_joints() + 1, kLowest);
  MatrixXd signs(blocks.cols(), kDraws);
  for (double& sign : signs.reshaped()) sign = random() & 1 ? 1 : -1;
  const ScoresInAddition scores_of(screen, candidates, options, chosen);
  tbb::parallel_for(0, kDraws, [&](int draw) {
    VectorXd g = VectorXd::Zero(screen.size());
    for (Eigen::Index b = 0; b < blocks.cols(); ++b) {
      g += signs(b, draw) * blocks.col(b);
    }
    const VectorXd scores = scores_of(g);
    for (size_t i = 0; i < candidates.size(); ++i) {
      double& own = best(draw, candidates[i].joint + 1);
      own = std::max(own, scores[i]);
    }
  });
  VectorXd largest = VectorXd::Constant(kDraws, kLowest);
  for (Eigen::Index place = 0; place < best.cols(); ++place) {
    largest = largest.cwiseMax(Excess(best.col(place)).deviations);
  }
  const PlaceExcess own = Excess(best.col(joint + 1));
  return std::min(
      OrderStatistic(best.rowwise().maxCoeff(), Limits().chance_quantile),
      own.median +
          own.scale * OrderStatistic(largest, Limits().chance_quantile));
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
                        Without(selection.chosen, k), candidate.joint, seed);
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
