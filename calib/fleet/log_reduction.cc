#include "calib/fleet/log_reduction.h"

#include <cmath>
#include <filesystem>

#include "calib/fleet/factor_calibration.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration_checks.h"
#include "calib/linear/factor_solution.h"
#include "calib/linear/residual_pass.h"
#include "calib/linear/transition_search.h"
#include "problems/make_rows.h"

namespace armcal {
namespace {

// All rows by the weights that they have in the log's own calibration.
std::vector<TriangularFactor> WeighedFactors(const LinearCalibration& own,
                                             const Progress& progress,
                                             const LogSet& log) {
  const int n = own.parameters.num_joints();
  const RobustLoss loss = own.solved ? own.loss : RobustLoss::kSquared;
  const Eigen::VectorXd noise =
      own.solved ? own.noise : Eigen::VectorXd(Eigen::VectorXd::Ones(n));
  ResidualPass pass(own.parameters, own.rows, {std::vector<bool>(n, true)},
                    progress, Prepare(log, own.preparation));
  std::vector<TriangularFactor> factors = EmptyFactors(own.parameters);
  pass.RunBatches("reducing", own.x, noise, [&](const BatchResidual& batch) {
    Eigen::VectorXd weights(batch.rows.count);
    const JointColumns& columns = batch.rows.columns;
    for (int i = 0; i < n; ++i) {
      for (long k = 0; k < batch.rows.count; ++k) {
        weights[k] = std::sqrt(EvaluateLoss(loss, batch.r(k, i)).weight);
      }
      factors[i].AddRows(columns.column(i, 0), columns.stride(),
                         batch.rows.count, weights.data());
    }
  });
  return factors;
}

// The log's own standard deviations over those of its factor alone.
std::optional<double> Inflation(const Robot& robot, const ReductionModel& model,
                                const LinearCalibration& own,
                                const ReducedLog& log) {
  // Too few rows to tell: their errors passed for independent.
  const bool measured = own.solved && own.score_window > 1;
  if (!measured) return std::nullopt;
  const LinearCalibration alone = CalibrateFromFactors(robot, {model, {log}});
  if (!alone.solved) return std::nullopt;
  return MedianInflation(own.covariance - own.scale_covariance,
                         alone.independent_covariance);
}

}  // namespace

ReductionModel ChooseReductionModel(const Robot& robot,
                                    const std::string& robot_sha256,
                                    const LinearCalibrationOptions& options,
                                    const LogSet& logs) {
  ReductionModel model;
  model.robot = robot.name;
  model.robot_sha256 = robot_sha256;
  model.gravity = robot.gravity;
  model.geometry = options.geometry;
  model.joint_terms = options.joint_terms;
  model.loss = options.loss.value_or(RobustLoss::kHuber);
  model.rows = MakeRowOptions(options, logs);
  CheckBandwidth(options.bandwidth_hz, logs);
  const PreparedLogs prepared = Prepare(
      logs, PreparationForRows(model.rows, model.loss != RobustLoss::kSquared));
  const Transitions transitions =
      FindTransitions(robot, options, model.rows, prepared);
  for (const auto& joint : transitions) {
    model.transitions.push_back(joint.front());
  }
  const ModelParameters parameters =
      MakeParameters(robot, options, transitions);
  for (const ModelParameter& p : parameters.parameters()) {
    model.parameters.push_back(p.name);
    model.units.push_back(p.unit);
  }
  return model;
}

ReducedLog ReduceLog(const Robot& robot, const ReductionModel& model,
                     const Progress& progress, const LogSet& log) {
  LinearCalibrationOptions options = model.Options();
  options.progress = progress;
  const LinearCalibration own = CalibrateLinear(robot, options, log, nullptr);
  const TimeBase& base = log.time_bases()[0];
  ReducedLog reduced;
  reduced.file = std::filesystem::path(log.path(0)).filename().string();
  reduced.torque = log.torque_source();
  reduced.torque_constants_stddev = log.torque_constants_stddev();
  reduced.samples = base.samples;
  reduced.range = base.range;
  reduced.resampled = !base.uniform;
  reduced.gaps = static_cast<int>(base.gaps.size());
  reduced.motion_hz = base.motion_hz;
  reduced.mean_square_speed = own.mean_square_speed;
  reduced.travel = own.travel;
  reduced.factors = WeighedFactors(own, progress, log);
  reduced.inflation = Inflation(robot, model, own, reduced);
  return reduced;
}

}  // namespace armcal
