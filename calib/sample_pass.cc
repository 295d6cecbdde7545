#include "calib/sample_pass.h"

#include "calib/sample_residuals.h"

namespace armcal {

using Eigen::MatrixXd;

SamplePass::SamplePass(const ModelParameters& parameters,
                       const Eigen::VectorXd& x, const Progress& progress,
                       LogSet* logs)
    : parameters_(parameters),
      x_(x),
      progress_(progress),
      logs_(logs),
      residuals_(logs->memory()) {}

void SamplePass::Run(const std::string& stage, const Visit& visit) {
  if (residuals_.whole()) {
    std::size_t next = 0;
    logs_->ForEachAtFullRate(stage, progress_,
                             [&](int log, const Trajectory& t) {
                               visit(log, t, residuals_.items()[next++]);
                             });
    return;
  }
  residuals_.Begin();
  std::vector<MotionRegressor> regressors(logs_->size(),
                                          MotionRegressor(parameters_));
  logs_->ForEachAtFullRate(stage, progress_, [&](int log, const Trajectory& t) {
    MatrixXd residuals = SampleResiduals(t, x_, &regressors[log]);
    const std::size_t bytes =
        static_cast<std::size_t>(residuals.size()) * sizeof(double);
    visit(log, t, *residuals_.Add(&residuals, bytes));
  });
  residuals_.End();
}

}  // namespace armcal
