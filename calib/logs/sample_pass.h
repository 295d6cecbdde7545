#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "calib/logs/prepared_logs.h"
#include "calib/logs/sample_residuals.h"
#include "model/dynamics/model_parameters.h"

namespace armcal {

// Passes over the torque samples of logs that look at their residuals at some
// parameters. All is kept from pass to pass as far as the logs' memory goes.
class SamplePass {
 public:
  // `residuals` of t.samples. Of the trajectory, samples, positions, standstill
  // and core; nothing else.
  using Visit = std::function<void(int log, const Trajectory& t,
                                   const SampleResiduals& residuals)>;

  SamplePass(const ModelParameters& parameters, const Eigen::VectorXd& x,
             const Progress& progress, const PreparedLogs& logs);

  int num_joints() const { return parameters_.num_joints(); }
  int num_logs() const { return logs_.size(); }
  // How far from the time at which a joint is seen to turn round it may have
  // done so, s.
  double turn_reach() const;

  // At full rate, outliers of the logs not replaced.
  void Run(const std::string& stage, const Visit& visit);

 private:
  ModelParameters parameters_;
  Eigen::VectorXd x_;
  Progress progress_;
  PreparedLogs logs_;
  struct Stretch {
    int log;
    Trajectory trajectory;
    SampleResiduals residuals;
  };
  KeptItems<Stretch> stretches_;
};

}  // namespace armcal
