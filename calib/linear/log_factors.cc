#include "calib/linear/log_factors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calib/linear/row_reduction.h"
#include "problems/make_rows.h"

namespace armcal {

// Reads all logs once and makes each a factor of its own. Later questions, of
// joints that are not powered or of the noise, are answered from the factors,
// whose size does not depend on the logs' length.
LogFactors::LogFactors(const ModelParameters& parameters,
                       const RowOptions& options, const Progress& progress,
                       const PreparedLogs& logs)
    : factors_(logs.size(),
               BlockTriangularFactor(parameters, RowsPerLeaf(options))),
      mean_square_speed_(Eigen::ArrayXd::Zero(parameters.num_joints())),
      travel_(Eigen::VectorXd::Zero(parameters.num_joints())) {
  std::vector<MotionRegressor> regressors(logs.size(),
                                          MotionRegressor(parameters));
  RowReduction reduction(parameters);
  double samples = 0;
  std::vector<Eigen::AlignedBox<double, Eigen::Dynamic>> met(
      logs.size(), Eigen::AlignedBox<double, Eigen::Dynamic>(travel_.size()));
  logs.ForEach("reading", progress, [&](int log, const Trajectory& t) {
    const int count = t.core_end - t.core_begin;
    if (count == 0) return;
    for (int j = 0; j < t.num_joints(); ++j) {
      for (int k = t.core_begin; k < t.core_end; ++k) {
        mean_square_speed_[j] += t.qd(k, j) * t.qd(k, j);
      }
    }
    const auto q = t.q.middleRows(t.core_begin, count);
    met[log].extend(q.colwise().minCoeff().transpose().eval());
    met[log].extend(q.colwise().maxCoeff().transpose().eval());
    samples += count;
    regressors[log].Enter(t);
    reduction.Add(*MakeRows(t, options, regressors[log]), &factors_[log]);
  });
  if (samples > 0) mean_square_speed_ /= samples;
  for (const auto& box : met) {
    if (!box.isEmpty()) travel_ = travel_.cwiseMax(box.sizes());
  }
}

BlockTriangularFactor LogFactors::Merged(
    const ModelParameters& parameters,
    const std::vector<std::vector<bool>>& powered) const {
  BlockTriangularFactor merged(parameters);
  for (int log = 0; log < size(); ++log) {
    for (int i = 0; i < parameters.num_joints(); ++i) {
      if (powered[log][i]) merged.Merge(factors_[log], i);
    }
  }
  return merged;
}

// Compares |y_i|, the norm of the torques, with sqrt(sum_c x_c^2 |U_ic|^2),
// what the terms would have if they did not cancel. Both norms are those of
// columns of R, as Q keeps lengths. In free swing the terms are large and
// cancel.
std::vector<std::vector<bool>> FindPowered(const LogFactors& factors,
                                           const Eigen::VectorXd& x,
                                           double share) {
  std::vector<std::vector<bool>> powered;
  for (int log = 0; log < factors.size(); ++log) {
    const BlockTriangularFactor& factor = factors.log(log);
    powered.emplace_back();
    for (int i = 0; i < factor.num_joints(); ++i) {
      const Eigen::MatrixXd& R = factor.Triangle(i);
      const std::vector<int>& columns = factor.columns(i);
      double terms = 0;
      for (size_t c = 0; c < columns.size(); ++c) {
        terms += std::pow(x[columns[c]], 2) * R.col(c).squaredNorm();
      }
      const double torque = R.rightCols<1>().norm();
      powered.back().push_back(torque > 0 &&
                               torque >= share * std::sqrt(terms));
    }
  }
  return powered;
}

std::vector<std::vector<bool>> FindNonzero(const LogFactors& factors) {
  std::vector<std::vector<bool>> nonzero;
  for (int log = 0; log < factors.size(); ++log) {
    const Eigen::VectorXd rms = RightSideRms(factors.log(log));
    nonzero.emplace_back();
    for (const double x : rms) nonzero.back().push_back(x > 0);
  }
  return nonzero;
}

}  // namespace armcal
