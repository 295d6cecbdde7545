#include "calib/fleet/log_evidence.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/median.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double NoiseFreedom(const LinearCalibration& own, double inflation) {
  const double spent =
      static_cast<double>(own.parameters.size()) / own.parameters.num_joints();
  return std::max(
      0., (static_cast<double>(own.equations) - spent) / inflation / inflation);
}

// As if the median were an estimate of kFleet degrees of freedom.
void ShrinkNoise(const VectorXd& freedom, MatrixXd* noise) {
  constexpr double kFleet = 20;
  for (Eigen::Index i = 0; i < noise->cols(); ++i) {
    std::vector<double> known;
    for (Eigen::Index u = 0; u < noise->rows(); ++u) {
      if (freedom[u] > 0) known.push_back(std::pow((*noise)(u, i), 2));
    }
    if (known.empty()) continue;
    const double median = Median(known);
    for (Eigen::Index u = 0; u < noise->rows(); ++u) {
      const double own = freedom[u] > 0 ? std::pow((*noise)(u, i), 2) : 0;
      (*noise)(u, i) = std::sqrt((kFleet * median + freedom[u] * own) /
                                 (kFleet + freedom[u]));
    }
  }
}

UnitEvidence EvidenceOf(const BlockTriangularFactor& factor,
                        const std::vector<bool>& used, const VectorXd& noise,
                        double inflation) {
  const int m = factor.num_parameters();
  UnitEvidence evidence{0, 0, MatrixXd::Zero(m, m), VectorXd::Zero(m)};
  for (int i = 0; i < factor.num_joints(); ++i) {
    if (!used[i]) continue;
    const std::vector<int>& columns = factor.columns(i);
    const auto k = static_cast<Eigen::Index>(columns.size());
    const MatrixXd R = factor.Triangle(i) / (noise[i] * inflation);
    evidence.information(columns, columns) +=
        R.leftCols(k).transpose() * R.leftCols(k);
    evidence.right(columns) += R.leftCols(k).transpose() * R.col(k);
  }
  return evidence;
}

}  // namespace armcal
