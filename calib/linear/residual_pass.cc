#include "calib/linear/residual_pass.h"

#include <utility>

#include "calib/linear/row_reduction.h"
#include "problems/make_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::size_t BytesOf(const RowBatch& batch, const ModelParameters& parameters) {
  std::size_t columns = 0;
  for (int i = 0; i < parameters.num_joints(); ++i) {
    columns += parameters.row_columns(i).size() + 1;
  }
  return columns * batch.columns.stride() * sizeof(double);
}

// Row k of a batch, in U that is 0 but for the joints' own columns.
void CopyRow(const RowBatch& batch, long k, const ModelParameters& parameters,
             IdentificationRow* row) {
  for (int i = 0; i < parameters.num_joints(); ++i) {
    const std::vector<int>& used = parameters.row_columns(i);
    const int size = static_cast<int>(used.size());
    for (int c = 0; c < size; ++c) {
      row->U(i, used[c]) = batch.columns.column(i, c)[k];
    }
    row->Y[i] = batch.columns.column(i, size)[k];
  }
}

}  // namespace

std::vector<TriangularFactor> EmptyFactors(const ModelParameters& parameters) {
  std::vector<TriangularFactor> factors;
  for (int i = 0; i < parameters.num_joints(); ++i) {
    factors.emplace_back(static_cast<int>(parameters.row_columns(i).size()));
  }
  return factors;
}

ResidualPass::ResidualPass(const ModelParameters& parameters,
                           const RowOptions& rows, const EquationMask& used,
                           const Progress& progress, const PreparedLogs& logs)
    : parameters_(parameters),
      rows_(rows),
      used_(used),
      progress_(progress),
      logs_(logs),
      kept_(logs.logs().memory()) {}

// Hands out rows one by one. U is set to 0 once, since the entries that rows
// fill are the same in each.
void ResidualPass::Run(const std::string& stage, const VectorXd& x,
                       const VectorXd& noise,
                       const std::function<void(const RowResidual&)>& visit) {
  const int n = parameters_.num_joints();
  IdentificationRow row;
  row.U = MatrixXd::Zero(n, parameters_.size());
  row.Y = VectorXd::Zero(n);
  RunBatches(stage, x, noise, [&](const BatchResidual& batch) {
    RowResidual residual{row, batch.log, batch.follows, VectorXd(n)};
    for (long k = 0; k < batch.rows.count; ++k) {
      CopyRow(batch.rows, k, parameters_, &row);
      residual.r = batch.r.row(k);
      visit(residual);
      residual.follows = true;
    }
  });
}

void ResidualPass::RunBatches(
    const std::string& stage, const VectorXd& x, const VectorXd& noise,
    const std::function<void(const BatchResidual&)>& visit) {
  ForEachBatch(stage, [&](const KeptBatch& kept) {
    visit({kept.rows, kept.log, kept.follows, Residuals(kept, x, noise)});
  });
  ++passes_;
}

// r = (y - U x) / noise of each joint, column by column: the batch lies in
// columns.
MatrixXd ResidualPass::Residuals(const KeptBatch& kept, const VectorXd& x,
                                 const VectorXd& noise) const {
  const JointColumns& columns = kept.rows.columns;
  const long count = kept.rows.count;
  MatrixXd residuals = MatrixXd::Zero(count, noise.size());
  for (int i = 0; i < noise.size(); ++i) {
    if (!used_[kept.log][i]) continue;
    const std::vector<int>& used = parameters_.row_columns(i);
    const int size = static_cast<int>(used.size());
    auto r = residuals.col(i);
    r = Eigen::Map<const VectorXd>(columns.column(i, size), count);
    for (int c = 0; c < size; ++c) {
      r -= x[used[c]] * Eigen::Map<const VectorXd>(columns.column(i, c), count);
    }
    r /= noise[i];
  }
  return residuals;
}

// Visits batches as kept by the last pass, if memory held all of them, or makes
// them from the logs. Making rows is most of a pass's time, and robust weights
// take several passes over the same rows.
void ResidualPass::ForEachBatch(
    const std::string& stage,
    const std::function<void(const KeptBatch&)>& visit) {
  if (kept_.whole()) {
    for (const KeptBatch& batch : kept_.items()) visit(batch);
    if (progress_) progress_(stage, 1);
    return;
  }
  kept_.Begin();
  std::vector<MotionRegressor> regressors(logs_.size(),
                                          MotionRegressor(parameters_));
  int last_log = -1, last_segment = -1;
  logs_.ForEach(stage, progress_, [&](int log, const Trajectory& t) {
    regressors[log].Enter(t);
    const auto rows = MakeRows(t, rows_, regressors[log]);
    ForEachBatchOnThreads(*rows, regressors[log], [&](RowBatch* batch) {
      const bool follows = log == last_log && t.segment == last_segment;
      last_log = log, last_segment = t.segment;
      KeptBatch kept{log, follows, std::move(*batch)};
      const std::size_t bytes =
          sizeof(KeptBatch) + BytesOf(kept.rows, parameters_);
      KeptBatch* const place = kept_.Add(&kept, bytes);
      visit(*place);
      if (place == &kept) *batch = std::move(kept.rows);  // not kept
    });
  });
  kept_.End();
}

}  // namespace armcal
