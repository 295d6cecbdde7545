#include "calib/output_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "calib/loop_fit.h"
#include "calib/loop_windows.h"
#include "calib/overlap_covariance.h"
#include "calib/posterior.h"
#include "calib/unseen_combinations.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 50;
constexpr int kMostHalvings = 8;
// A step of this many deviations (white noise's), rms over parameters, is none.
constexpr double kSettled = 1e-5;

LoopValues FilesValues(const Robot& robot, const ControllerOptions& controller,
                       const OutputErrorOptions& options) {
  CoulombTransition transition;
  transition.width = options.coulomb_width;
  LoopValues values;
  values.arm.robot = robot;
  values.arm.transitions.assign(robot.links.size(), transition);
  const auto n = static_cast<Eigen::Index>(controller.drives.size());
  values.kp.resize(n);
  values.kd.resize(n);
  values.ki.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    values.kp[j] = controller.drives[j].kp;
    values.kd[j] = controller.drives[j].kd;
    values.ki[j] = controller.drives[j].ki;
  }
  values.delay = controller.delay;
  // The same all through an estimate, whose cost would jump with them.
  values.substeps = EnoughSubsteps(values, controller.rate_hz);
  return values;
}

class Calibrator {
 public:
  Calibrator(const Robot& robot, const ControllerOptions& controller,
             const OutputErrorOptions& options,
             const std::vector<CommandedLog>& training)
      : options_(options),
        files_(FilesValues(robot, controller, options)),
        windows_(robot, controller, options.window_s, training) {}

  OutputErrorCalibration Run() {
    result_.values = files_;
    result_.arm.robot = files_.arm.robot;
    result_.positions.noise = windows_.noise();
    result_.positions.nominal = windows_.ResidualRms(files_);
    LoopEquations equations = windows_.Linearise(files_, options_.progress);
    if (!equations.finite) {
      result_.arm.reason =
          "the loop of the robot file's arm and this controller is not stable";
      return result_;
    }
    unknowns_.emplace(files_, options_.trust, options_.joint_terms,
                      equations.torque_rms);
    fit_.emplace(*unknowns_, options_.trust);
    x_ = unknowns_->nominal();
    Iterate(&equations);
    if (!result_.arm.solved) return result_;
    result_.values = unknowns_->At(x_);
    result_.arm.robot = result_.values.arm.robot;
    result_.positions.calibrated = windows_.ResidualRms(result_.values);
    Report(equations);
    return result_;
  }

 private:
  void Iterate(LoopEquations* equations);
  // Towards x, as far as the cost falls; false where it does not.
  bool Step(const VectorXd& x, LoopEquations* equations);
  void Report(const LoopEquations& equations);

  const OutputErrorOptions& options_;
  LoopValues files_;
  LoopWindows windows_;
  std::optional<LoopUnknowns> unknowns_;
  std::optional<LoopFit> fit_;
  VectorXd x_;
  OutputErrorCalibration result_;
};

bool Calibrator::Step(const VectorXd& x, LoopEquations* equations) {
  const VectorXd begin = x_, dx = x - x_;
  const double cost = equations->cost + fit_->PriorCost(x_);
  double share = 1;
  for (int k = 0; k < kMostHalvings; ++k, share /= 2) {
    // Bodies between two that can exist can exist.
    x_ = begin + share * dx;
    windows_.Move(*equations, dx, share);
    LoopEquations next =
        windows_.Linearise(unknowns_->At(x_), options_.progress);
    if (!next.finite || !(next.cost + fit_->PriorCost(x_) < cost)) continue;
    *equations = std::move(next);
    return true;
  }
  x_ = begin;
  windows_.Move(*equations, 0 * dx, 0);
  return false;
}

void Calibrator::Iterate(LoopEquations* equations) {
  const double size = std::sqrt(static_cast<double>(unknowns_->size()));
  result_.arm.reason = "NO_CONVERGENCE";
  for (int k = 0; k < kMostIterations; ++k) {
    VectorXd x = x_;
    if (!fit_->Solve(equations->R, equations->z + equations->R * x_, &x)) {
      result_.arm.reason = "the numbers of the logs overflow";
      return;
    }
    result_.arm.solved = true;
    result_.arm.iterations = k + 1;
    const double moved = (equations->R * (x - x_)).norm() / size;
    const bool lower = Step(x, equations);
    // At the bottom rounding decides whether the cost still falls.
    if (moved < kSettled || (!lower && moved < 1e3 * kSettled)) {
      result_.arm.reason = "CONVERGENCE";
      return;
    }
    if (!lower) return;
  }
}

void Calibrator::Report(const LoopEquations& equations) {
  const std::vector<int> free = unknowns_->FreeIndices();
  const LoopScores scores = windows_.Scores(result_.values, equations);
  const double excess = scores.residual_squares / scores.expected_squares;
  result_.model_error = std::sqrt(excess);
  const auto trusting = [&](double inertia, double times) {
    return Posterior(equations.R, fit_->PriorInformation(inertia, times), free);
  };
  const double inertia = options_.trust.inertia;
  const Posterior posterior = trusting(inertia, 1);
  const MatrixXd covariance =
      excess * posterior.Sandwich(SquareRoot(scores.covariance)) +
      posterior.Sandwich(SquareRoot(fit_->PriorInformation(inertia, 1)));
  // Where a second's scores scatter by more than noise explains, the model is
  // wrong, and they tell how sure the estimate is.
  constexpr double kBeyondChance = 2;  // of a variance from 20 seconds
  const VectorXd scatter = posterior.Sandwich(scores.sums).diagonal();
  const VectorXd known = covariance.diagonal();
  const MatrixXd raised = RaiseTo(
      (scatter.array() > kBeyondChance * known.array()).select(scatter, known),
      covariance);
  // Identifiable: what files that are trusted to 100 % do not double.
  const VectorXd trusted = trusting(1, 1).Gain().diagonal();
  const VectorXd untrusted = trusting(100, 100).Gain().diagonal();
  NonlinearCalibration& arm = result_.arm;
  for (int k = 0; k < unknowns_->size(); ++k) {
    PhysicalParameter out;
    out.name = unknowns_->name(k);
    out.unit = unknowns_->unit(k);
    out.value = x_[k];
    out.prior = unknowns_->nominal()[k];
    out.held = !unknowns_->is_free(k);
    out.geometry = false;
    out.identifiable = !out.held && untrusted[k] < 2 * trusted[k];
    out.at_bound = !out.held && unknowns_->is_positive(k) &&
                   x_[k] < unknowns_->least(k) + 1e-6 * unknowns_->prior(k);
    out.stddev = out.identifiable ? std::sqrt(raised(k, k))
                                  : std::numeric_limits<double>::infinity();
    arm.parameters.push_back(out);
  }
  arm.covariance = raised;
  std::vector<std::string> names;
  for (const int k : free) names.push_back(unknowns_->name(k));
  const MatrixXd nothing = MatrixXd::Zero(0, unknowns_->size());
  arm.unseen = UnseenCombinations(
      free, names, equations.R,
      Posterior(nothing, fit_->PriorInformation(1, 1), free).Gain().diagonal());
}

}  // namespace

OutputErrorCalibration CalibrateOutputError(
    const Robot& robot, const ControllerOptions& controller,
    const OutputErrorOptions& options,
    const std::vector<CommandedLog>& training,
    const std::vector<CommandedLog>& validation) {
  OutputErrorCalibration result =
      Calibrator(robot, controller, options, training).Run();
  if (result.arm.solved && !validation.empty()) {
    result.positions.validation =
        LoopWindows(robot, controller, options.window_s, validation)
            .ResidualRms(result.values);
  }
  return result;
}

}  // namespace armcal
