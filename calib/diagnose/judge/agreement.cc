#include "calib/diagnose/judge/agreement.h"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>

#include "calib/diagnose/select/chosen.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool Disagreement::IsReal(double drop, double form) const {
  constexpr double kChance = .0027;
  if (freedom <= 0 || chi_squared <= form * drop) return false;
  const boost::math::chi_squared chance(freedom);
  return boost::math::cdf(boost::math::complement(chance, chi_squared)) <
         kChance;
}

Disagreement DisagreementOf(const GapFit& fit, size_t k) {
  constexpr double kTells = .01;  // of what all joints tell
  const GapScreen& screen = fit.screen();
  const std::vector<int>& chosen = fit.selection().chosen;
  const GapScreen::Fit all = screen.Solve(ColumnsOf(fit.candidates(), chosen));
  const std::vector<int>& columns = fit.candidates()[chosen[k]].columns;
  std::vector<MatrixXd> rows;
  double told = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    rows.emplace_back(screen.num_rows(j), columns.size());
    for (size_t c = 0; c < columns.size(); ++c) {
      rows[j].col(c) = screen.Projected(columns[c], j);
    }
    told += rows[j].squaredNorm();
  }
  Disagreement disagreement;
  int joints = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    if (rows[j].squaredNorm() <= kTells * told) continue;
    ++joints;
    MatrixXd information = rows[j].transpose() * rows[j];
    information.diagonal().array() += 1e-9 * information.trace() + 1e-12;
    const VectorXd wanted = rows[j].transpose() * screen.Residual(j, all);
    disagreement.chi_squared += wanted.dot(information.ldlt().solve(wanted));
  }
  disagreement.freedom = (joints - 1) * static_cast<int>(columns.size());
  return disagreement;
}

}  // namespace armcal
