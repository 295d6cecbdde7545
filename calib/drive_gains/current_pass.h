#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>

#include "calib/drive_gains/solution.h"
#include "calib/linear/residual_pass.h"
#include "calib/logs/prepared_logs.h"
#include "model/dynamics/model_parameters.h"
#include "problems/identification_rows.h"

namespace armcal {

// One row of every joint's currents with its residuals at an estimate.
struct CurrentRow {
  const IdentificationRow& row;
  int log;       // the bare arm's first
  bool loaded;   // with the payload
  bool follows;  // comes right after the row before it, without a gap
  // Per joint, in units of its noise; 0 where that is 0.
  Eigen::VectorXd r;
};

// Passes over the logs of the bare arm, then over those with a payload.
class CurrentPass {
 public:
  // B: m x 10, what a body on the last link adds to the parameters; `payload`
  // may be null.
  CurrentPass(const ModelParameters& parameters, const RowOptions& rows,
              const Eigen::MatrixXd& B, const Progress& progress,
              const PreparedLogs& bare, const PreparedLogs* payload);

  const ModelParameters& parameters() const { return bare_.parameters(); }
  const Eigen::MatrixXd& B() const { return B_; }
  bool has_payload() const { return loaded_.has_value(); }
  int num_logs() const { return logs_bare_ + logs_loaded_; }
  int passes() const { return bare_.passes(); }

  void Run(const std::string& stage, const GainEstimate& estimate,
           const Eigen::VectorXd& noise,
           const std::function<void(const CurrentRow&)>& visit);
  // The equations' factors in one pass; weight(r) is each equation's, of its
  // residual in units of noise.
  CurrentFactors Factors(const std::string& stage, const GainEstimate& estimate,
                         const Eigen::VectorXd& noise,
                         const std::function<double(double)>& weight,
                         const std::function<void(const CurrentRow&)>& visit);

 private:
  Eigen::MatrixXd B_;
  int logs_bare_, logs_loaded_;
  ResidualPass bare_;
  std::optional<ResidualPass> loaded_;
};

}  // namespace armcal
