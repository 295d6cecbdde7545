#include "calib/diagnose/judge/agreement.h"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>

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

// Of the k-th of these effects, as the fit beside all others has it.
VectorXd CoefficientsOf(const GapFit& fit, size_t k,
                        const GapScreen::Fit& all) {
  Eigen::Index begin = 0;
  const std::vector<int>& chosen = fit.selection().chosen;
  for (size_t i = 0; i < k; ++i) {
    begin += fit.candidates()[chosen[i]].columns.size();
  }
  return all.coefficients.segment(begin,
                                  fit.candidates()[chosen[k]].columns.size());
}

}  // namespace

bool Agreement::Differ(double drop, double form) const {
  return freedom > 0 && chi_squared > form * drop &&
         IsMoreThanChance(chi_squared, freedom);
}

Agreement AgreementOn(const GapFit& fit, size_t k) {
  const GapScreen& screen = fit.screen();
  const std::vector<int>& chosen = fit.selection().chosen;
  const GapScreen::Fit all = screen.Solve(ColumnsOf(fit.candidates(), chosen));
  const std::vector<int>& columns = fit.candidates()[chosen[k]].columns;
  const int size = static_cast<int>(columns.size());
  const VectorXd x = CoefficientsOf(fit, k, all);
  std::vector<MatrixXd> rows;
  double told = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    rows.emplace_back(screen.num_rows(j), size);
    for (int c = 0; c < size; ++c) {
      rows[j].col(c) = screen.Projected(columns[c], j);
    }
    told += rows[j].squaredNorm();
  }
  Agreement agreement;
  int tell = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    agreement.moving += screen.num_rows(j) > 0;
    MatrixXd information = rows[j].transpose() * rows[j];
    information.diagonal().array() += 1e-9 * information.trace() + 1e-12;
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
