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

// The tail probability of chi squared with `freedom` degrees below that of
// three standard deviations of a normal variable.
bool IsMoreThanChance(double chi_squared, int freedom) {
  const boost::math::chi_squared chance(freedom);
  return boost::math::cdf(boost::math::complement(chance, chi_squared)) <
         kChance;
}

// What was chosen as columns that come one after the other, without the
// baseline's own delay of all joints: given that no joint would see one, only
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
  return freedom > 0 && chi_squared > form * delta_chi2 &&
         IsMoreThanChance(chi_squared, freedom);
}

// The fit of all chosen effects has one size x of the k-th for all joints. With
// P_j its projected columns on joint j and r_j what all effects leave there,
// joint j by itself would have the size x + d_j,
//   d_j = (P_j' P_j)^-1 P_j' r_j,
// and the fit would be better by d_j' P_j' P_j d_j = (P_j' r_j)' d_j. Their sum
// is chi squared of (joints - 1) times as many degrees as there are columns
// where all joints have the same size: Cochran's Q of a meta-analysis (1954). A
// joint with less than Limits().tells of the effect's squared torque has no
// say. A ridge of 1e-9 keeps joints solvable that have one of two columns only.
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
    agreement.delta_chi2 += x.dot(information * x);
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
