#include "calib/diagnose/changes/search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/diagnose/changes/candidates.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A change is told where it is 99 times as likely as none.
constexpr double kCertain = .99;
constexpr int kMostTaken = 12;

// The changes of a series while they are looked for.
class ChangeSelection {
 public:
  ChangeSelection(const std::vector<LogEquations>& logs,
                  const std::vector<ScatterComponent>& components,
                  const std::vector<ChangeHypothesis>& hypotheses,
                  const VectorXd& times)
      : logs_(logs),
        components_(components),
        hypotheses_(hypotheses),
        times_(times) {
    scatter_.stddev.resize(static_cast<Eigen::Index>(components.size()));
    for (size_t k = 0; k < components.size(); ++k) {
      scatter_.stddev[static_cast<Eigen::Index>(k)] = .5 * components[k].usual;
    }
    Refit();
  }

  int size() const { return static_cast<int>(taken_.size()); }

  // All candidates given those taken.
  ChangeCandidates Judge() const {
    ChangeCandidates all =
        JudgeCandidates({logs_, components_, hypotheses_, times_}, scatter_,
                        Columns(), Prior());
    const auto taken = [this](const ChangeCandidate& c) {
      return std::any_of(
          taken_.begin(), taken_.end(), [&](const ChangeCandidate& t) {
            return FamilyOf(t) == FamilyOf(c) && t.course == c.course;
          });
    };
    all.erase(std::remove_if(all.begin(), all.end(), taken), all.end());
    return all;
  }
  void Take(const ChangeCandidate& candidate) {
    taken_.push_back(candidate);
    Refit();
  }
  ChangeCandidate TakeOut(int k) {
    const ChangeCandidate out = taken_[k];
    taken_.erase(taken_.begin() + k);
    with_all_ = scatter_;
    Refit();
    return out;
  }
  // Back where it was, with the scatter that there was.
  void PutBack(int k, const ChangeCandidate& candidate) {
    taken_.insert(taken_.begin() + k, candidate);
    scatter_ = with_all_;
  }
  void Refit() {
    const LogColumns columns = Columns();
    for (size_t k = 0; k < components_.size(); ++k) {
      double& size = scatter_.stddev[static_cast<Eigen::Index>(k)];
      size = std::max(size, .5 * components_[k].usual);
    }
    scatter_ = FitScatter(logs_, components_, columns, Prior(), scatter_,
                          fit_inflation_);
  }
  // Given all changes taken; then it stays, or it would take the place of a
  // change that is taken out.
  void FitInflation() {
    fit_inflation_ = true;
    Refit();
    fit_inflation_ = false;
  }
  const Scatter& scatter() const { return scatter_; }
  VectorXd Level() const {
    const SeriesFit fit(logs_, components_, scatter_, Columns(), Prior());
    return fit.value().head(logs_[0].root.cols());
  }

 private:
  int FamilyOf(const ChangeCandidate& candidate) const {
    return hypotheses_[candidate.hypothesis].family;
  }
  LogColumns Columns() const {
    LogColumns columns;
    for (size_t l = 0; l < logs_.size(); ++l) {
      MatrixXd all(logs_[l].root.rows(), Prior().size());
      Eigen::Index at = 0;
      for (const ChangeCandidate& taken : taken_) {
        const ChangeHypothesis& hypothesis = hypotheses_[taken.hypothesis];
        const MatrixXd& own = hypothesis.columns[l];
        const VectorXd course =
            CourseOf(taken.course, times_, hypothesis.motion);
        all.middleCols(at, own.cols()) =
            course[static_cast<Eigen::Index>(l)] * own;
        at += own.cols();
      }
      columns.push_back(all);
    }
    return columns;
  }
  VectorXd Prior() const {
    std::vector<double> prior;
    for (const ChangeCandidate& taken : taken_) {
      const VectorXd& own = hypotheses_[taken.hypothesis].prior;
      prior.insert(prior.end(), own.begin(), own.end());
    }
    return Eigen::Map<VectorXd>(prior.data(),
                                static_cast<Eigen::Index>(prior.size()));
  }

  const std::vector<LogEquations>& logs_;
  const std::vector<ScatterComponent>& components_;
  const std::vector<ChangeHypothesis>& hypotheses_;
  const VectorXd& times_;
  std::vector<ChangeCandidate> taken_;
  Scatter scatter_, with_all_;
  bool fit_inflation_ = false;
};

// A family and form with its probability.
struct FamilyShare {
  int family;
  FoundChange::Rival of;
  std::vector<std::pair<double, int>> places;  // probability, log
};

// Of all candidates, likeliest first; what is left to 1 is that of none.
std::vector<FamilyShare> SharesOf(
    const ChangeCandidates& all,
    const std::vector<ChangeHypothesis>& hypotheses) {
  const double most = std::max(0., all.front().log_odds);
  double sum = std::exp(-most);
  for (const ChangeCandidate& c : all) sum += std::exp(c.log_odds - most);
  std::vector<FamilyShare> shares;
  for (const ChangeCandidate& c : all) {
    const double p = std::exp(c.log_odds - most) / sum;
    const int family = hypotheses[c.hypothesis].family;
    auto share =
        std::find_if(shares.begin(), shares.end(), [&](const FamilyShare& s) {
          return s.family == family && s.of.form == c.course.form;
        });
    if (share == shares.end()) {
      shares.push_back({family, {c.hypothesis, c.course.form, 0}, {}});
      share = shares.end() - 1;
    }
    share->of.probability += p;
    share->places.push_back({p, c.course.log});
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const FamilyShare& a, const FamilyShare& b) {
                     return a.of.probability > b.of.probability;
                   });
  return shares;
}

// Logs that have 95 % of a share together, ascending.
std::vector<int> LogsOf(const FamilyShare& share) {
  std::map<int, double> of_log;
  for (const auto& [p, log] : share.places) of_log[log] += p;
  std::vector<std::pair<double, int>> order;
  for (const auto& [log, p] : of_log) order.push_back({p, log});
  std::sort(order.rbegin(), order.rend());
  std::vector<int> logs;
  double covered = 0;
  for (const auto& [p, log] : order) {
    if (covered >= .95 * share.of.probability) break;
    covered += p;
    logs.push_back(log);
  }
  std::sort(logs.begin(), logs.end());
  return logs;
}

// The likeliest change, with what is told of it among all candidates.
FoundChange ToldAmong(const ChangeCandidates& all,
                      const std::vector<ChangeHypothesis>& hypotheses) {
  const ChangeCandidate& best = all.front();
  FoundChange found;
  found.hypothesis = best.hypothesis;
  found.course = best.course;
  found.value = best.value;
  found.covariance = best.covariance;
  for (const FamilyShare& share : SharesOf(all, hypotheses)) {
    found.any += share.of.probability;
    if (share.of.form == ChangeForm::kMotion) {
      found.with_motion += share.of.probability;
    }
    if (share.family == hypotheses[best.hypothesis].family &&
        share.of.form == best.course.form) {
      found.probability = share.of.probability;
      found.logs = LogsOf(share);
    } else {
      found.rivals.push_back(share.of);
    }
  }
  return found;
}

// Each change for the likeliest in its place; whether all stayed.
bool ExchangeEach(ChangeSelection* selection) {
  bool stayed = true;
  for (int k = 0; k < selection->size(); ++k) {
    const ChangeCandidate was = selection->TakeOut(k);
    const ChangeCandidate best = selection->Judge().front();
    const bool same =
        best.hypothesis == was.hypothesis && best.course == was.course;
    selection->PutBack(k, best);
    if (same) continue;
    selection->Refit();
    stayed = false;
  }
  return stayed;
}

// The least certain change, where one is not certain enough, goes.
bool LeaveOut(const std::vector<ChangeHypothesis>& hypotheses,
              ChangeSelection* selection, std::vector<FoundChange>* told) {
  told->clear();
  int least = -1;
  for (int k = 0; k < selection->size(); ++k) {
    const ChangeCandidate own = selection->TakeOut(k);
    told->push_back(ToldAmong(selection->Judge(), hypotheses));
    selection->PutBack(k, own);
    if (told->back().any < kCertain &&
        (least < 0 || told->back().any < (*told)[least].any)) {
      least = k;
    }
  }
  if (least < 0) return false;
  selection->TakeOut(least);
  selection->Refit();
  return true;
}

}  // namespace

SeriesChanges FindChanges(const std::vector<LogEquations>& logs,
                          const std::vector<ScatterComponent>& components,
                          const std::vector<ChangeHypothesis>& hypotheses,
                          const VectorXd& times) {
  ChangeSelection selection(logs, components, hypotheses, times);
  while (selection.size() < kMostTaken) {
    const ChangeCandidates candidates = selection.Judge();
    if (candidates.front().log_odds < 0) break;
    selection.Take(candidates.front());
    // A drift may first look like a step, and what is one change like two.
    ExchangeEach(&selection);
  }
  selection.FitInflation();
  for (int round = 0; round < 2 && !ExchangeEach(&selection); ++round) {
  }
  SeriesChanges result;
  while (LeaveOut(hypotheses, &selection, &result.changes)) {
    ExchangeEach(&selection);
  }
  std::sort(result.changes.begin(), result.changes.end(),
            [](const FoundChange& a, const FoundChange& b) {
              return a.course.log < b.course.log;
            });
  result.scatter = selection.scatter();
  result.level = selection.Level();
  return result;
}

}  // namespace armcal
