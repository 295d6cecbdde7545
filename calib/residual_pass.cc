#include "calib/residual_pass.h"

#include "calib/row_reduction.h"

namespace armcal {

ResidualPass::ResidualPass(const ModelParameters& parameters,
                           const RowOptions& rows, const EquationMask& used,
                           const Progress& progress, LogSet* logs)
    : parameters_(parameters),
      rows_(rows),
      used_(used),
      progress_(progress),
      logs_(logs) {}

void ResidualPass::Run(const std::string& stage, const Eigen::VectorXd& x,
                       const Eigen::VectorXd& noise,
                       const std::function<void(const RowResidual&)>& visit) {
  std::vector<MotionRegressor> regressors(logs_->size(),
                                          MotionRegressor(parameters_));
  int last_log = -1, last_segment = -1;
  logs_->ForEach(stage, progress_, [&](int log, const Trajectory& t) {
    regressors[log].Enter(t);
    const auto rows = MakeRows(t, rows_, regressors[log]);
    ForEachRowOnThreads(*rows, regressors[log], [&](const auto& row) {
      const bool follows = log == last_log && t.segment == last_segment;
      last_log = log, last_segment = t.segment;
      RowResidual residual{row, log, follows,
                           (row.Y - row.U * x).cwiseQuotient(noise)};
      for (int i = 0; i < residual.r.size(); ++i) {
        if (!used_[log][i]) residual.r[i] = 0;
      }
      visit(residual);
    });
  });
  ++passes_;
}

}  // namespace armcal
