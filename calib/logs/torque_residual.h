#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/logs/prepared_logs.h"
#include "model/dynamics/model_parameters.h"
#include "model/signals/trajectory.h"
#include "problems/identification_rows.h"

namespace armcal {

// Torques of parameters x at every sample of a trajectory that `regressor` has
// entered, samples in rows.
Eigen::MatrixXd PredictTorques(const Trajectory& trajectory,
                               const Eigen::VectorXd& x,
                               const MotionRegressor& regressor);

// The samples of a trajectory's core in rows, both low-passed at the bandwidth
// (order 4, zero phase; 0: as they are).
struct FilteredTorques {
  Eigen::MatrixXd recorded, predicted;
};
// `regressor` has entered the trajectory.
FilteredTorques FilterTorques(const Trajectory& trajectory,
                              const Eigen::VectorXd& x, double bandwidth_hz,
                              const MotionRegressor& regressor);

// How far predicted torques are from recorded ones, over the samples of one or
// several logs: both low-passed at the bandwidth (order 4, zero phase). All
// vectors have an entry per joint; a percentage is 100 |tau - tau_hat| / |tau|
// in 2-norm, NaN where the torque is zero. Torque outliers count like the rest
// in all but `kept`.
class TorqueResidual {
 public:
  struct Figures {
    Eigen::VectorXd torque_rms;    // N m or N
    Eigen::VectorXd residual_rms;  // N m or N
    Eigen::VectorXd percent;
    double stacked_percent;  // all joints as one vector
  };

  explicit TorqueResidual(int num_joints);

  // Adds the core of a trajectory that `regressor` has entered.
  void Add(const Trajectory& trajectory, const Eigen::VectorXd& x,
           double bandwidth_hz, const MotionRegressor& regressor);

  // Without standstill, and of all samples.
  Figures moving() const { return MakeFigures(moving_); }
  Figures whole() const { return MakeFigures(whole_); }
  // As `moving`, of the torque that a fit takes: with what stands for samples
  // that it leaves out, which is its own prediction of them.
  Figures kept() const { return MakeFigures(kept_); }
  // The share of samples that standstill excludes.
  double excluded_share() const;
  long samples() const { return static_cast<long>(whole_.count); }

 private:
  struct Sums {
    void Add(const FilteredTorques& torques, int row);

    Eigen::ArrayXd torque, residual;
    double count = 0;
  };
  static Figures MakeFigures(const Sums& sums);

  Sums moving_, whole_, kept_;
};

// Of parameters `x` over all logs, in one pass that `progress` knows as
// `stage`.
TorqueResidual EvaluateTorqueResidual(const ModelParameters& parameters,
                                      const Eigen::VectorXd& x,
                                      double bandwidth_hz,
                                      const std::string& stage,
                                      const Progress& progress,
                                      const PreparedLogs& logs);

}  // namespace armcal
