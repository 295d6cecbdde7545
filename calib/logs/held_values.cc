#include "calib/logs/held_values.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/median.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Eigen::Index kReach = 4;  // rows to both sides of a step
// Repeats of a value that a slower controller holds: a loop of 40 Hz in a log
// of 1 kHz.
constexpr long kLongestHold = 25;
// Of the steps of what is not at rest. A rounded value with noise of s of its
// quanta repeats itself in 1 / (2 s sqrt(pi)) of the steps, and the changes
// after a repeat are half a normal distribution, whose tenths differ by
// sqrt(2) 1.65 s quanta to one. So more than .2 of repeats come from s
// below 1.4, where changes differ by less than 3.3; held values change by as
// much as the motion does.
constexpr double kHeldShare = .2;
constexpr double kVaried = 4;  // ninth tenth over first tenth of these changes
// Whole rows, in which all columns would have to repeat by chance at once: as
// for samples that are lost.
constexpr double kRepeatedShare = .1;
// A change after one repeat is of two steps; rounded values repeat where they
// are slow, and go on by the least that they can.
constexpr double kLarger = 1.3;
constexpr size_t kLeastChanges = 50;

// Whether each row is the row before, in all columns.
std::vector<bool> Repeats(const MatrixXd& x) {
  std::vector<bool> repeats(x.rows(), false);
  for (Eigen::Index k = 1; k < x.rows(); ++k) {
    repeats[k] = x.row(k) == x.row(k - 1);
  }
  return repeats;
}

// The share of rows that repeat the one before. Those that do so in a run of
// twice kReach are at rest, or stuck, unless the position of their joint, if it
// is given, goes on meanwhile; what repeats longer than kLongestHold is stuck.
double ShareOf(const std::vector<bool>& repeats,
               const VectorXd& position = VectorXd()) {
  long steps = 0, held = 0, run = 0;
  const auto end_run = [&](size_t end) {
    const auto last = static_cast<Eigen::Index>(end) - 1;
    const bool goes_on = run <= kLongestHold && position.size() > 0 &&
                         position[last] != position[last - run];
    if (run < 2 * kReach || goes_on) {
      held += run;
      steps += run;
    }
    run = 0;
  };
  for (size_t k = 1; k < repeats.size(); ++k) {
    if (repeats[k]) {
      ++run;
      continue;
    }
    end_run(k);
    ++steps;
  }
  end_run(repeats.size());
  return static_cast<double>(held) / static_cast<double>(std::max(1L, steps));
}

// Whether the changes of a column after repeats vary as those of a motion, and
// are larger than the others: they are of the time that has gone since.
bool GoesOn(const VectorXd& x, const std::vector<bool>& repeats) {
  std::vector<double> after, others;
  for (Eigen::Index k = 2; k < x.size(); ++k) {
    const double change = std::abs(x[k] - x[k - 1]);
    if (change > 0) (repeats[k - 1] ? after : others).push_back(change);
  }
  if (after.size() < kLeastChanges) return false;
  return Quantile(after, .9) > kVaried * Quantile(after, .1) &&
         (others.size() < kLeastChanges ||
          Quantile(after, .5) > kLarger * Quantile(others, .5));
}

}  // namespace

std::vector<InspectionFinding> AuditHeldValues(const Robot& robot,
                                               const Log& log) {
  const std::pair<const char*, const MatrixXd*> signals[] = {
      {"position", &log.q}, {"velocity", &log.qd}, {"torque", &log.tau}};
  std::vector<InspectionFinding> findings;
  MatrixXd all(log.size(), 0);
  for (const auto& [name, x] : signals) {
    if (x->size() == 0) continue;
    MatrixXd more(log.size(), all.cols() + x->cols());
    more << all, *x;
    all = std::move(more);
  }
  const std::vector<bool> rows = Repeats(all);
  bool vary = false;
  for (Eigen::Index c = 0; c < all.cols(); ++c) {
    vary = vary || GoesOn(all.col(c), rows);
  }
  if (vary && ShareOf(rows) > kRepeatedShare) {
    return {{"repeated_rows", "rows repeat the row before in all columns",
             Format("%.0f %% of the rows in motion", 100 * ShareOf(rows)),
             "log each sample once: the motion goes on in between"}};
  }
  for (const auto& [name, x] : signals) {
    if (x == &log.qd) continue;  // made of rounded positions, or not used
    for (Eigen::Index j = 0; j < x->cols(); ++j) {
      const std::vector<bool> repeats = Repeats(x->col(j));
      const double share = x == &log.tau && log.q.cols() > j
                               ? ShareOf(repeats, log.q.col(j))
                               : ShareOf(repeats);
      if (share < kHeldShare || !GoesOn(x->col(j), repeats)) continue;
      findings.push_back(
          {"held",
           std::string("the ") + name + " of " + robot.links[j].joint.name +
               " is held over several rows",
           Format("%.0f %% of its values, rests apart, are the value before",
                  100 * share),
           "log it when it is sampled, or each row's own value",
           static_cast<int>(j)});
    }
  }
  return findings;
}

}  // namespace armcal
