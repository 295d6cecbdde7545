#include "tests/blind/model_residual.h"

#include <glog/logging.h>

#include <cmath>

#include "calib/closed_loop/commanded_torque.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidthHz = 10;
// Of the motion that the model is given: friction changes sign within 50 ms,
// and a velocity slower than that would leave torques several times the noise.
constexpr double kMotionBandwidthHz = 40;

// Coulomb friction as the plant has it, per unit of its size.
double Coulomb(double v, double width) { return v / std::hypot(v, width); }

std::string Describe(const std::vector<ChosenEffect>& effects) {
  std::string text;
  for (const ChosenEffect& effect : effects) {
    text += effect.kind->name + "@" + std::to_string(effect.joint);
    char number[32];
    for (const double p : effect.parameters) {
      std::snprintf(number, sizeof number, " %.17g", p);
      text += number;
    }
    text += ";";
  }
  return text;
}

// By the drives' own law, without the noise of the recorded torques.
MatrixXd TorqueOfCommands(const BlindCase& blind, const Scenario& scenario,
                          const Log& log) {
  CommandedLog commanded{"made", log};
  commanded.log.t.array() -= log.t[0];
  return CommandedTorque(blind.robot, scenario.loop.controller, commanded,
                         commanded.log.t);
}

}  // namespace

PlantMotion MotionOf(const Log& log) {
  const VectorXd dt = Differentiate(log.t, 1);
  const auto rate = [&dt](const MatrixXd& x) {
    return MatrixXd(Differentiate(x, 1).array().colwise() / dt.array());
  };
  PlantMotion motion;
  motion.rate = SensorOptions().log_rate_hz;
  motion.q = ZeroPhaseLowPass(log.q, motion.rate, kMotionBandwidthHz,
                              Ends::kExtrapolate);
  motion.qd = rate(motion.q);
  motion.qdd = rate(motion.qd);
  return motion;
}

PlantMotion MotionOf(const ReferenceMotion& reference, double rate) {
  const int rows = static_cast<int>(reference.duration * rate) + 1;
  const long n = reference.at(0).q.size();
  PlantMotion motion{MatrixXd(rows, n), MatrixXd(rows, n), MatrixXd(rows, n),
                     rate};
  for (int k = 0; k < rows; ++k) {
    const ReferencePoint point = reference.at(k / rate);
    motion.q.row(k) = point.q;
    motion.qd.row(k) = point.qd;
    motion.qdd.row(k) = point.qdd;
  }
  return motion;
}

VectorXd ZeroVelocityWidths(const BlindCase& blind) {
  VectorXd widths(blind.robot.num_joints());
  for (int j = 0; j < widths.size(); ++j) {
    const bool turns = IsRotational(blind.robot.links[j].joint.type);
    widths[j] = (turns ? 1 : .3) * blind.zero_velocity;
  }
  return widths;
}

MatrixXd ModelTorque(const Robot& robot, const VectorXd& widths,
                     const PlantMotion& motion) {
  MatrixXd tau(motion.q.rows(), motion.q.cols());
  for (int k = 0; k < tau.rows(); ++k) {
    const VectorXd qd = motion.qd.row(k), qdd = motion.qdd.row(k);
    tau.row(k) = InverseDynamics(robot, motion.q.row(k), qd, qdd);
    for (int j = 0; j < tau.cols(); ++j) {
      const Joint& joint = robot.links[j].joint;
      tau(k, j) += joint.armature * qdd[j] + joint.viscous * qd[j] +
                   joint.coulomb * Coulomb(qd[j], widths[j]) + joint.offset;
    }
  }
  return tau;
}

MatrixXd ThinTorque(const MatrixXd& x, double rate) {
  const int stride = static_cast<int>(std::lround(rate / kResidualRateHz));
  const MatrixXd smooth = ZeroPhaseLowPass(x, rate, kBandwidthHz);
  const int skip = static_cast<int>(rate);
  MatrixXd thin((x.rows() - 1 - 2 * skip) / stride + 1, x.cols());
  for (int k = 0; k < thin.rows(); ++k) {
    thin.row(k) = smooth.row(skip + k * stride);
  }
  return thin;
}

MatrixXd FileError(const BlindCase& blind, const PlantMotion& motion) {
  const Robot truth =
      TrueRobot(QuietScenario(blind, BlindLog::kTraining, {})).robot;
  const VectorXd widths = ZeroVelocityWidths(blind);
  return ThinTorque(ModelTorque(truth, widths, motion) -
                        ModelTorque(blind.robot, widths, motion),
                    motion.rate);
}

std::optional<ModelResidual> SimulateResidual(const BlindCase& blind,
                                              const Scenario& scenario) {
  const ScenarioRun run = RunScenario(scenario, ScenarioEngine::kRigidArm);
  if (!Follows(run.run)) return std::nullopt;
  const PlantMotion motion = MotionOf(run.run.log);
  const MatrixXd model =
      ModelTorque(blind.robot, ZeroVelocityWidths(blind), motion);
  const MatrixXd torque = blind.has_torque
                              ? run.run.log.tau
                              : TorqueOfCommands(blind, scenario, run.run.log);
  return ModelResidual{ThinTorque(torque - model, motion.rate), motion};
}

const ModelResidual* QuietRuns::Run(const std::vector<ChosenEffect>& effects) {
  const std::string key = Describe(effects);
  const auto found = runs_.find(key);
  auto& run = found != runs_.end() ? found->second : runs_[key];
  if (found == runs_.end()) {
    run = SimulateResidual(blind_, QuietScenario(blind_, log_, effects));
    // Motions are large, and only that without effects is asked for.
    if (run && !effects.empty()) run->motion = {};
  }
  return run ? &*run : nullptr;
}

const MatrixXd* QuietRuns::Residual(const std::vector<ChosenEffect>& effects) {
  const ModelResidual* run = Run(effects);
  return run ? &run->torque : nullptr;
}

const PlantMotion& QuietRuns::Motion() {
  const ModelResidual* run = Run({});
  CHECK(run) << "an arm without effects follows";
  return run->motion;
}

}  // namespace armcal
