#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "calib/linear/residual_pass.h"
#include "calib/logs/prepared_logs.h"
#include "calib/refine/trajectory_correction.h"
#include "model/dynamics/model_parameters.h"

namespace armcal {

// Where a refinement stands.
struct TrajectoryEstimate {
  ModelParameters parameters;
  Eigen::VectorXd x;
  // How far the log widths of Coulomb friction have moved from the start; empty
  // where widths are given.
  Eigen::VectorXd log_width;
  TrajectoryNoise noise;
  EquationMask used;         // [log][joint]
  std::vector<bool> frozen;  // joints whose torque noise must stay

  int size() const { return static_cast<int>(x.size() + log_width.size()); }
};

// The normal equations of x and the log widths about an estimate.
struct TrajectoryEquations {
  explicit TrajectoryEquations(int num_joints)
      : encoder(num_joints), torque(num_joints) {}

  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;
  NoiseSums encoder, torque;
  bool failed = false;  // a spline was not determined, or there was none
};

// Passes over the logs that look at every stretch of motion with its spline.
class TrajectoryPass {
 public:
  using Visit = std::function<void(int log, TrajectoryCorrection* stretch)>;

  // Logs must have been prepared to be taken as they are.
  TrajectoryPass(double knot_s, const Progress& progress,
                 const PreparedLogs& logs)
      : knot_s_(knot_s), progress_(progress), logs_(logs) {}

  // Stretches with the splines that fit their positions alone.
  void ForEach(const std::string& stage, const ModelParameters& parameters,
               const Visit& visit);
  // Fits and eliminates the splines; `visit`, where given, sees them then.
  TrajectoryEquations Gather(const std::string& stage,
                             const TrajectoryEstimate& estimate,
                             TorqueWeighting weighting, const Visit& visit);

  double step_s() const { return logs_.time_bases()[0].dt; }
  int passes() const { return passes_; }

 private:
  double knot_s_;
  Progress progress_;
  PreparedLogs logs_;
  int passes_ = 0;
};

// Standard deviations from the splines of the positions alone, at an
// estimate's x.
TrajectoryNoise GuessTrajectoryNoise(const TrajectoryEstimate& estimate,
                                     TrajectoryPass* pass);
// Re-estimated from what equations say of the residuals, degrees of freedom
// counted; `huber`: by Huber's second proposal. Returns the largest relative
// change.
double UpdateTrajectoryNoise(const TrajectoryEquations& equations, bool huber,
                             TrajectoryEstimate* estimate);

}  // namespace armcal
