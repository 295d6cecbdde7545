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

// Gradients of the screen's columns with each block of the residual alone,
// screen columns x blocks. Their sum over blocks is the gradient of the
// residual, and with signs it is that of a residual whose blocks have these
// signs, without the rows being touched again.
MatrixXd BlockGradients(const GapScreen& screen, const GapRows& rows,
                        const GapScreen::Fit& fit) {
  const int n = rows.num_joints();
  std::map<std::pair<int, long>, int> blocks;
  std::vector<std::vector<std::pair<int, long>>> of_row(n);
  const JointRows residual = screen.Residuals(fit);
  for (int j = 0; j < n; ++j) {
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

// Standardised by median and upper tail, not by mean and deviation: one draw in
// which a place scores high by chance must not hide that it does so rarely. A
// scale of at least 1 keeps places whose candidates never score from being
// divided by nothing.
PlaceExcess Excess(const VectorXd& scores) {
  PlaceExcess excess;
  excess.median = OrderStatistic(scores, .5);
  excess.scale = std::max(1., OrderStatistic(scores, .9) - excess.median);
  excess.deviations = (scores.array() - excess.median) / excess.scale;
  return excess;
}

}  // namespace

// A randomisation test (Fisher 1935; as wild bootstrap of blocks, Wu 1986 and
// Shao 2010). Under the hypothesis that nothing but the chosen effects is
// there, each block of what they leave is as likely to have come with the
// opposite sign. The residual is drawn kDraws times with random signs of its
// blocks, each draw goes through the whole search for one more effect, and the
// best score of each place (joint or whole robot) is kept: the maximum over all
// candidates accounts for how many were looked at (Westfall and Young 1993).
//
// Of two thresholds the lower one counts: the quantile of the largest score of
// all, and the quantile of the largest in units of each place's own tail, put
// back into those of the asked joint. The second asks less of a joint that is
// well explained where another one is not, whose structured residual would else
// set the threshold for all.
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

// Backward elimination: of all chosen effects the one with the least margin
// goes first, and the rest is asked again, since what it explained is part of
// the residual from then on. The margin is the smaller of two, both on the
// scale of a score: delta_chi2 / Inflation - Penalty less the threshold, which
// judges the effect against its own rows' scatter, and the score less what
// chance gives, which judges it against a search as wide as the one that found
// it.
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
          selection.delta_chi2[k] / Inflation(screen, rows, candidate, fit) -
          Penalty(screen, candidate);
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
