#include "calib/diagnose/judge/agreement.h"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <numeric>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Three standard deviations of a normal variable, both sides.
constexpr double kChance = .0027;

bool IsMoreThanChance(double chi_squared, int freedom) {
  const boost::math::chi_squared chance(freedom);
  return boost::math::cdf(boost::math::complement(chance, chi_squared)) <
         kChance;
}

// What was chosen as columns that come one after the other, without the
// baseline's own delay of all joints: beside that no joint would see one, only
// its prior would tell that it is too large.
GapScreen WithoutTiming(const GapFit& fit) {
  GapScreen screen =
      fit.screen().Only(ColumnsOf(fit.candidates(), fit.selection().chosen));
  const std::vector<BaselineColumn>& columns = fit.baseline().columns();
  std::vector<int> timing;
  for (size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].kind == BaselineColumn::Kind::kTiming) {
      timing.push_back(static_cast<int>(c));
    }
  }
  screen.ScaleBaseline(timing, 0);
  return screen;
}

}  // namespace

bool Agreement::Differ(double form) const {
  return freedom > 0 && chi_squared > form * drop &&
         IsMoreThanChance(chi_squared, freedom);
}

Agreement AgreementOn(const GapFit& fit, size_t k) {
  const GapScreen screen = WithoutTiming(fit);
  const std::vector<int>& chosen = fit.selection().chosen;
  std::vector<int> every(screen.size());
  std::iota(every.begin(), every.end(), 0);
  const GapScreen::Fit all = screen.Solve(every);
  int first = 0;
  for (size_t i = 0; i < k; ++i) {
    first += static_cast<int>(fit.candidates()[chosen[i]].columns.size());
  }
  const int size = static_cast<int>(fit.candidates()[chosen[k]].columns.size());
  const VectorXd x = all.coefficients.segment(first, size);
  std::vector<MatrixXd> rows;
  double told = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    rows.emplace_back(screen.num_rows(j), size);
    for (int c = 0; c < size; ++c) {
      rows[j].col(c) = screen.Projected(first + c, j);
    }
    told += rows[j].squaredNorm();
  }
  Agreement agreement;
  int tell = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    agreement.moving += screen.num_rows(j) > 0;
    MatrixXd information = rows[j].transpose() * rows[j];
    information.diagonal().array() += 1e-9 * information.trace() + 1e-12;
    agreement.drop += x.dot(information * x);
    const VectorXd wanted = rows[j].transpose() * screen.Residual(j, all);
    const VectorXd further = information.ldlt().solve(wanted);
    const VectorXd alone = x + further;
    agreement.seen_by += IsMoreThanChance(alone.dot(information * alone), size);
    if (rows[j].squaredNorm() <= Limits().tells * told) continue;
    ++tell;
    agreement.chi_squared += wanted.dot(further);
  }
  agreement.freedom = (tell - 1) * size;
  return agreement;
}

}  // namespace armcal
