#pragma once

#include <vector>

#include "calib/logs/prepared_logs.h"
#include "calib/numerics/block_triangular_factor.h"
#include "model/dynamics/model_parameters.h"
#include "problems/identification_rows.h"

namespace armcal {

// The factors of several logs' equations, one each, so that equations of single
// joints of single logs can be left out without reading the logs again.
class LogFactors {
 public:
  // One pass over the logs.
  LogFactors(const ModelParameters& parameters, const RowOptions& options,
             const Progress& progress, const PreparedLogs& logs);
  // As they were once found.
  LogFactors(std::vector<BlockTriangularFactor> factors,
             const Eigen::ArrayXd& mean_square_speed,
             const Eigen::VectorXd& travel)
      : factors_(std::move(factors)),
        mean_square_speed_(mean_square_speed),
        travel_(travel) {}

  const BlockTriangularFactor& log(int k) const { return factors_[k]; }
  int size() const { return static_cast<int>(factors_.size()); }
  // Mean square of joint speeds met, (rad/s)^2 or (m/s)^2, per joint.
  const Eigen::ArrayXd& mean_square_speed() const { return mean_square_speed_; }
  // How far each joint travels, rad or m: the most of all logs.
  const Eigen::VectorXd& travel() const { return travel_; }

  // All equations but those of (log, joint) for which powered[log][joint] is
  // false.
  BlockTriangularFactor Merged(
      const ModelParameters& parameters,
      const std::vector<std::vector<bool>>& powered) const;

 private:
  std::vector<BlockTriangularFactor> factors_;
  Eigen::ArrayXd mean_square_speed_;
  Eigen::VectorXd travel_;
};

// Which equations have a drive torque worth the name: its rms is at least
// `share` of that of the terms x makes of them.
std::vector<std::vector<bool>> FindPowered(const LogFactors& factors,
                                           const Eigen::VectorXd& x,
                                           double share);
// All whose torque is not zero throughout.
std::vector<std::vector<bool>> FindNonzero(const LogFactors& factors);

}  // namespace armcal
