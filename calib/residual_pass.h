#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "calib/log_set.h"
#include "model/model_parameters.h"
#include "problems/identification_rows.h"

namespace armcal {

// One row of every joint with its residuals at some parameters.
struct RowResidual {
  const IdentificationRow& row;
  int log;
  bool follows;  // comes right after the row before it, without a gap
  // Per joint, in units of its noise; 0 where the equation is left out.
  Eigen::VectorXd r;
};

// Which equations count: [log][joint].
using EquationMask = std::vector<std::vector<bool>>;

// Passes over the logs that look at every row's residual. Rows are kept from
// pass to pass as far as the logs' memory goes, so the logs must stay as they
// are prepared.
class ResidualPass {
 public:
  ResidualPass(const ModelParameters& parameters, const RowOptions& rows,
               const EquationMask& used, const Progress& progress,
               LogSet* logs);

  // The same passes for another model, which must outlive them.
  ResidualPass WithParameters(const ModelParameters& parameters) const {
    return ResidualPass(parameters, rows_, used_, progress_, logs_);
  }
  const ModelParameters& parameters() const { return parameters_; }
  int num_logs() const { return logs_->size(); }
  bool uses(int log, int joint) const { return used_[log][joint]; }
  int passes() const { return passes_; }

  void Run(const std::string& stage, const Eigen::VectorXd& x,
           const Eigen::VectorXd& noise,
           const std::function<void(const RowResidual&)>& visit);

 private:
  struct KeptRow {
    int log;
    bool follows;
    IdentificationRow row;
  };
  void ForEachRow(const std::string& stage,
                  const std::function<void(const KeptRow&)>& visit);

  const ModelParameters& parameters_;
  RowOptions rows_;
  EquationMask used_;
  Progress progress_;
  LogSet* logs_;
  int passes_ = 0;
  KeptItems<KeptRow> kept_;
};

}  // namespace armcal
