#include "calib/drive_gains/current_pass.h"

#include <cmath>
#include <vector>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ResidualPass MakePass(const ModelParameters& parameters, const RowOptions& rows,
                      const Progress& progress, const PreparedLogs& logs) {
  const EquationMask all(logs.size(),
                         std::vector<bool>(parameters.num_joints(), true));
  return ResidualPass(parameters, rows, all, progress, logs);
}

}  // namespace

CurrentPass::CurrentPass(const ModelParameters& parameters,
                         const RowOptions& rows, const MatrixXd& B,
                         const Progress& progress, const PreparedLogs& bare,
                         const PreparedLogs* payload)
    : B_(B),
      logs_bare_(bare.size()),
      logs_loaded_(payload == nullptr ? 0 : payload->size()),
      bare_(MakePass(parameters, rows, progress, bare)) {
  if (payload == nullptr) return;
  loaded_.emplace(MakePass(parameters, rows, progress, *payload));
}

void CurrentPass::Run(const std::string& stage, const GainEstimate& estimate,
                      const VectorXd& noise,
                      const std::function<void(const CurrentRow&)>& visit) {
  for (const bool loaded : {false, true}) {
    if (loaded && !loaded_) continue;
    const VectorXd x =
        loaded ? VectorXd(estimate.x + B_ * estimate.p) : estimate.x;
    ResidualPass& pass = loaded ? *loaded_ : bare_;
    // With parameters 0 and noise 1 its residuals are the currents.
    pass.Run(stage, VectorXd::Zero(x.size()), VectorXd::Ones(noise.size()),
             [&](const RowResidual& current) {
               const VectorXd error =
                   current.r - estimate.g.cwiseProduct(current.row.U * x);
               CurrentRow row{current.row,
                              current.log + (loaded ? logs_bare_ : 0), loaded,
                              current.follows, VectorXd::Zero(noise.size())};
               for (int i = 0; i < noise.size(); ++i) {
                 if (noise[i] > 0) row.r[i] = error[i] / noise[i];
               }
               visit(row);
             });
  }
}

CurrentFactors CurrentPass::Factors(
    const std::string& stage, const GainEstimate& estimate,
    const VectorXd& noise, const std::function<double(double)>& weight,
    const std::function<void(const CurrentRow&)>& visit) {
  CurrentFactors factors(parameters());
  Run(stage, estimate, noise, [&](const CurrentRow& row) {
    BlockTriangularFactor& factor = row.loaded ? factors.loaded : factors.bare;
    for (int i = 0; i < noise.size(); ++i) {
      const double w = weight(row.r[i]);
      if (w <= 0) continue;
      factor.Add(i, row.row.U.row(i), row.row.Y[i], std::sqrt(w));
    }
    visit(row);
  });
  return factors;
}

}  // namespace armcal
