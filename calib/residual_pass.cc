#include "calib/residual_pass.h"

#include "calib/row_reduction.h"

namespace armcal {
namespace {

std::size_t BytesOf(const IdentificationRow& row) {
  return static_cast<std::size_t>(row.U.size() + row.Y.size()) * sizeof(double);
}

}  // namespace

ResidualPass::ResidualPass(const ModelParameters& parameters,
                           const RowOptions& rows, const EquationMask& used,
                           const Progress& progress, LogSet* logs)
    : parameters_(parameters),
      rows_(rows),
      used_(used),
      progress_(progress),
      logs_(logs),
      kept_(logs->memory()) {}

void ResidualPass::Run(const std::string& stage, const Eigen::VectorXd& x,
                       const Eigen::VectorXd& noise,
                       const std::function<void(const RowResidual&)>& visit) {
  ForEachRow(stage, [&](const KeptRow& kept) {
    RowResidual residual{kept.row, kept.log, kept.follows,
                         (kept.row.Y - kept.row.U * x).cwiseQuotient(noise)};
    for (int i = 0; i < residual.r.size(); ++i) {
      if (!used_[kept.log][i]) residual.r[i] = 0;
    }
    visit(residual);
  });
  ++passes_;
}

void ResidualPass::ForEachRow(
    const std::string& stage,
    const std::function<void(const KeptRow&)>& visit) {
  if (kept_.whole()) {
    for (const KeptRow& row : kept_.items()) visit(row);
    if (progress_) progress_(stage, 1);
    return;
  }
  kept_.Begin();
  std::vector<MotionRegressor> regressors(logs_->size(),
                                          MotionRegressor(parameters_));
  int last_log = -1, last_segment = -1;
  logs_->ForEach(stage, progress_, [&](int log, const Trajectory& t) {
    regressors[log].Enter(t);
    const auto rows = MakeRows(t, rows_, regressors[log]);
    ForEachRowOnThreads(*rows, regressors[log], [&](const auto& row) {
      const bool follows = log == last_log && t.segment == last_segment;
      last_log = log, last_segment = t.segment;
      KeptRow kept{log, follows, row};
      visit(*kept_.Add(&kept, sizeof(KeptRow) + BytesOf(row)));
    });
  });
  kept_.End();
}

}  // namespace armcal
