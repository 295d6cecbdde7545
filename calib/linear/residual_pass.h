#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "calib/numerics/triangular_factor.h"
#include "model/dynamics/model_parameters.h"
#include "problems/identification_rows.h"

namespace armcal {

// One row of every joint with its residuals at some parameters; without its
// time.
struct RowResidual {
  const IdentificationRow& row;
  int log;
  bool follows;  // comes right after the row before it, without a gap
  // Per joint, in units of its noise; 0 where the equation is left out.
  Eigen::VectorXd r;
};

// Some rows that follow each other, with their residuals.
struct BatchResidual {
  const RowBatch& rows;
  int log;
  bool follows;  // the first of them
  // Rows x joints, in units of noise; 0 where the equation is left out.
  Eigen::MatrixXd r;
};

// Which equations count: [log][joint].
using EquationMask = std::vector<std::vector<bool>>;

// A factor for each joint's equations, without any.
std::vector<TriangularFactor> EmptyFactors(const ModelParameters& parameters);

// Passes over the logs that look at every row's residual. Rows are kept from
// pass to pass as far as the logs' memory goes, so the logs must stay as they
// are prepared.
class ResidualPass {
 public:
  ResidualPass(const ModelParameters& parameters, const RowOptions& rows,
               const EquationMask& used, const Progress& progress,
               const PreparedLogs& logs);

  // The same passes for another model, which must outlive them.
  ResidualPass WithParameters(const ModelParameters& parameters) const {
    return ResidualPass(parameters, rows_, used_, progress_, logs_);
  }
  const ModelParameters& parameters() const { return parameters_; }
  int num_logs() const { return logs_.size(); }
  bool uses(int log, int joint) const { return used_[log][joint]; }
  int passes() const { return passes_; }

  void Run(const std::string& stage, const Eigen::VectorXd& x,
           const Eigen::VectorXd& noise,
           const std::function<void(const RowResidual&)>& visit);
  // The same, many rows at a time.
  void RunBatches(const std::string& stage, const Eigen::VectorXd& x,
                  const Eigen::VectorXd& noise,
                  const std::function<void(const BatchResidual&)>& visit);

 private:
  struct KeptBatch {
    int log;
    bool follows;
    RowBatch rows;
  };
  void ForEachBatch(const std::string& stage,
                    const std::function<void(const KeptBatch&)>& visit);
  Eigen::MatrixXd Residuals(const KeptBatch& kept, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& noise) const;

  const ModelParameters& parameters_;
  RowOptions rows_;
  EquationMask used_;
  Progress progress_;
  PreparedLogs logs_;
  int passes_ = 0;
  KeptItems<KeptBatch> kept_;
};

}  // namespace armcal
