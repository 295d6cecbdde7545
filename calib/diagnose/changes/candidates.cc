#include "calib/diagnose/changes/candidates.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Changes that a series has before it is seen, on average.
constexpr double kExpectedChanges = .5;
// How they are shared: a drift in half of the cases from the first log on.
constexpr double kShareOfSteps = .55, kShareOfDrifts = .35, kShareOfOnce = .1;
// What goes with motion is thought as likely as all of these together: it may
// be either that makes logs of other motions differ.
constexpr double kShareOfMotion = 1;

struct Place {
  ChangeCourse course;
  double prior;  // of a change, to have this course
};

// A step has two logs or more on both sides, a drift four logs or more; what
// settles does so from the first log on.
std::vector<Place> Places(int logs, const ChangeHypothesis& own) {
  std::vector<Place> places;
  for (int l = 2; l + 2 <= logs; ++l) {
    places.push_back({{ChangeForm::kStep, l, 0}, kShareOfSteps / (logs - 3)});
  }
  for (int l = 0; l < logs; ++l) {
    places.push_back({{ChangeForm::kOnce, l, 0}, kShareOfOnce / logs});
  }
  const int later = logs - 4;
  for (int l = 0; l <= later; ++l) {
    const double share = later == 0 ? 1 : l == 0 ? .5 : .5 / later;
    const int shapes = l == 0 ? kDriftShapes : 1;
    for (int shape = 0; shape < shapes; ++shape) {
      places.push_back(
          {{ChangeForm::kDrift, l, shape}, kShareOfDrifts * share / shapes});
    }
  }
  for (int measure = 0; measure < own.motion.cols(); ++measure) {
    places.push_back(
        {{ChangeForm::kMotion, 0, measure}, kShareOfMotion / kMotionMeasures});
  }
  return places;
}

// log(sum of exp).
double LogSum(const VectorXd& x) {
  const double most = x.maxCoeff();
  return most + std::log((x.array() - most).exp().sum());
}

// Scatter of a hypothesis's components at each of several sizes, and the
// logarithms of the priors of these.
struct ScatterGrid {
  std::vector<Scatter> at;
  VectorXd log_prior;
};

// Sizes of a hypothesis's own components from a tenth of what is estimated (of
// a third of the usual, where that is more) to four times it, each with the
// other components that are not friction as they are and at a quarter, since a
// change that is not in the fit yet is spread over all that is like it. The
// prior is that of the size times it, as the grid is one of its logarithm.
ScatterGrid MakeGrid(const SeriesProblem& problem, const Scatter& scatter,
                     const std::vector<int>& own) {
  constexpr int kDown = 5, kUp = 3;
  constexpr double kGridStep = .7;  // of the logarithm to base 2
  ScatterGrid grid;
  grid.log_prior.resize(2 * (kDown + kUp + 1));
  for (const double others : {1., .25}) {
    Scatter from = scatter;
    for (size_t k = 0; k < problem.components.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (!problem.components[k].is_friction) from.stddev[i] *= others;
    }
    for (int step = -kDown; step <= kUp; ++step) {
      Scatter at = from;
      double size = 0;  // relative to the usual, mean
      for (const int k : own) {
        const double usual = problem.components[k].usual;
        at.stddev[k] = std::exp2(kGridStep * step) *
                       std::max(scatter.stddev[k], usual / 3);
        size += at.stddev[k] / usual / static_cast<double>(own.size());
      }
      grid.log_prior[static_cast<Eigen::Index>(grid.at.size())] =
          std::log(size) - .5 * (kScatterFreedom + 1) *
                               std::log1p(size * size / kScatterFreedom);
      grid.at.push_back(at);
    }
  }
  return grid;
}

// Candidates of one hypothesis, over the grid.
ChangeCandidates JudgeOverGrid(const SeriesProblem& problem, int hypothesis,
                               const ScatterGrid& grid,
                               const LogColumns& columns,
                               const VectorXd& prior) {
  const ChangeHypothesis& own = problem.hypotheses[hypothesis];
  const std::vector<Place> places =
      Places(static_cast<int>(problem.logs.size()), own);
  const auto sizes = static_cast<Eigen::Index>(grid.at.size());
  VectorXd without = grid.log_prior;
  std::vector<std::vector<Gain>> gains(places.size());
  for (Eigen::Index g = 0; g < sizes; ++g) {
    const SeriesFit fit(problem.logs, problem.components, grid.at[g], columns,
                        prior);
    without[g] += fit.log_evidence();
    const ColumnSums sums = fit.Sums(own.columns);
    for (size_t k = 0; k < places.size(); ++k) {
      gains[k].push_back(
          fit.Add(sums, CourseOf(places[k].course, problem.times, own.motion),
                  own.prior));
    }
  }
  ChangeCandidates candidates;
  for (size_t k = 0; k < places.size(); ++k) {
    VectorXd with = without;
    for (Eigen::Index g = 0; g < sizes; ++g) {
      with[g] += gains[k][g].log_bayes_factor;
    }
    const double all = LogSum(with);
    // The mixture of what each size of the scatter makes of the change.
    const Eigen::Index p = own.prior.size();
    VectorXd value = VectorXd::Zero(p);
    MatrixXd square = MatrixXd::Zero(p, p);
    for (Eigen::Index g = 0; g < sizes; ++g) {
      const double weight = std::exp(with[g] - all);
      const VectorXd& x = gains[k][g].value;
      value += weight * x;
      square += weight * (gains[k][g].covariance + x * x.transpose());
    }
    candidates.push_back(
        {hypothesis, places[k].course,
         all - LogSum(without) +
             std::log(kExpectedChanges * own.share * places[k].prior),
         value, square - value * value.transpose()});
  }
  return candidates;
}

// The likeliest first.
void Sort(ChangeCandidates* candidates) {
  std::stable_sort(
      candidates->begin(), candidates->end(),
      [](const auto& a, const auto& b) { return a.log_odds > b.log_odds; });
}

}  // namespace

ChangeCandidates JudgeCandidates(const SeriesProblem& problem,
                                 const Scatter& scatter,
                                 const LogColumns& columns,
                                 const VectorXd& prior) {
  constexpr size_t kLookedInto = 6;  // hypotheses
  ScatterGrid as_is;
  as_is.at = {scatter};
  as_is.log_prior = VectorXd::Zero(1);
  std::vector<std::pair<double, int>> best;
  for (size_t h = 0; h < problem.hypotheses.size(); ++h) {
    const int hypothesis = static_cast<int>(h);
    ChangeCandidates own =
        JudgeOverGrid(problem, hypothesis, as_is, columns, prior);
    Sort(&own);
    best.push_back({own[0].log_odds, hypothesis});
  }
  std::sort(best.rbegin(), best.rend());
  best.resize(std::min(best.size(), kLookedInto));
  ChangeCandidates all;
  for (const auto& [odds, hypothesis] : best) {
    const ChangeCandidates own = JudgeOverGrid(
        problem, hypothesis,
        MakeGrid(problem, scatter, problem.hypotheses[hypothesis].scatter),
        columns, prior);
    all.insert(all.end(), own.begin(), own.end());
  }
  Sort(&all);
  return all;
}

}  // namespace armcal
