#include "calib/diagnose/data/days.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <set>

#include "calib/diagnose/data/column_prior.h"
#include "calib/diagnose/data/thresholds.h"

namespace armcal {

namespace {

// Of the day: torques' zeros, or all others.
std::vector<int> ColumnsOfDay(const GapBaseline& baseline, bool zeros) {
  std::vector<int> columns;
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    const bool is_zero =
        static_cast<JointTerm>(column.index) == JointTerm::kOffset;
    if (column.kind == BaselineColumn::Kind::kDay && is_zero == zeros) {
      columns.push_back(c);
    }
  }
  return columns;
}

}  // namespace

std::vector<int> DayColumns(const GapBaseline& baseline) {
  return ColumnsOfDay(baseline, false);
}

std::vector<int> ZeroColumns(const GapBaseline& baseline) {
  return ColumnsOfDay(baseline, true);
}

// The largest one against the root mean square of the n others: Student's t of
// n degrees, at ChanceBeyond of all joints together (Bonferroni); then the
// next against what is left, as long as two others are.
std::vector<int> BeyondTheOthers(const GapBaseline& baseline,
                                 const Eigen::VectorXd& x) {
  std::vector<int> zeros = ZeroColumns(baseline), beyond;
  const double joints = static_cast<double>(zeros.size());
  std::sort(zeros.begin(), zeros.end(),
            [&](int a, int b) { return std::abs(x[a]) > std::abs(x[b]); });
  while (zeros.size() > 2) {
    const int largest = zeros.front();
    zeros.erase(zeros.begin());
    const double n = static_cast<double>(zeros.size());
    const boost::math::students_t t(n);
    const double most = boost::math::quantile(boost::math::complement(
                            t, ChanceBeyond() / (2 * joints))) *
                        std::sqrt(x(zeros).squaredNorm() / n);
    if (std::abs(x[largest]) < most) break;
    beyond.push_back(largest);
  }
  return beyond;
}

std::vector<int> NotableZeros(const GapBaseline& baseline,
                              const Eigen::VectorXd& x) {
  const std::vector<int> zeros = ZeroColumns(baseline);
  const double least =
      Limits().notable *
      std::sqrt(x(zeros).squaredNorm() / std::max<double>(1, zeros.size()));
  std::vector<int> notable;
  for (const int c : zeros) {
    if (std::abs(x[c]) > least) notable.push_back(c);
  }
  return notable;
}

// Columns x of friction from day to day are N(0, 1) before, and an estimate of
// one is N(0, 1 - c), c what is left of its variance: an estimate within a
// prior scatters the less, the less the data say. With S that covariance, x'
// S^-1 x is chi squared of as many degrees as columns, and (sum x)^2 / sum(S)
// of one, the mean's, which is the sharper test of all joints going one way, as
// temperature makes them. The smaller tail counts, twice (Bonferroni).
std::vector<int> ChangedTogether(const GapBaseline& baseline, JointTerm term,
                                 const Eigen::VectorXd& x,
                                 const Eigen::MatrixXd& covariance) {
  std::vector<int> told, changed;
  for (const int c : DayColumns(baseline)) {
    if (static_cast<JointTerm>(baseline.columns()[c].index) != term) continue;
    if (!IsToldByData(covariance(c, c))) continue;
    told.push_back(c);
    if (std::abs(x[c]) > 1) changed.push_back(c);
  }
  if (changed.size() < 2) return {};
  // An estimate within a prior of variance 1 is N(0, 1 - what is left of it).
  const Eigen::Index count = static_cast<Eigen::Index>(told.size());
  const Eigen::MatrixXd scatter =
      Eigen::MatrixXd::Identity(count, count) - covariance(told, told);
  const Eigen::VectorXd own = x(told);
  const double of_each = own.dot(scatter.ldlt().solve(own));
  const double of_mean = own.sum() * own.sum() / scatter.sum();
  using boost::math::cdf;
  using boost::math::chi_squared;
  using boost::math::complement;
  const double chance = std::min(cdf(complement(chi_squared(count), of_each)),
                                 cdf(complement(chi_squared(1), of_mean)));
  if (2 * chance > ChanceBeyond()) return {};
  return changed;
}

bool IsAnotherDay(const GapBaseline& baseline, const Eigen::VectorXd& x,
                  const Eigen::MatrixXd& covariance) {
  std::set<int> changed;
  for (const int c : DayColumns(baseline)) {
    if (std::abs(x[c]) > Limits().clear_of_many * std::sqrt(covariance(c, c))) {
      changed.insert(baseline.columns()[c].joint);
    }
  }
  for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb}) {
    if (!ChangedTogether(baseline, term, x, covariance).empty()) return true;
  }
  return static_cast<int>(changed.size()) >=
         SeveralOf(baseline.robot().num_joints());
}

}  // namespace armcal
