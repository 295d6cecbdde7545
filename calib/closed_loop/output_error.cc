#include "calib/closed_loop/output_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "calib/closed_loop/fit.h"
#include "calib/closed_loop/windows.h"
#include "calib/linear/overlap_covariance.h"
#include "calib/numerics/posterior.h"
#include "calib/numerics/unseen_combinations.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostDescents = 50;
constexpr int kMostHalvings = 8;
// A step of this many deviations (white noise's), rms over parameters, is the
// last: those after it are several times smaller each.
constexpr double kNearer = .1;
// Where the file is far from the truth a few short windows show the way as well
// as all of them, until they have got as near as they tell. What they do not
// explain yet counts as noise: against a thousand deviations of the encoders
// nothing holds a value near its file's, and those that positions hardly tell
// (all torques times two) go anywhere.
constexpr double kFewWindow = 1;  // s
constexpr int kFew = 4;           // one in so many
constexpr double kNear = 1;
// Linearised, a stable loop makes several times its encoders' noise of it;
// where it makes a hundred times what is left, motions grow without bound, and
// deviations by it mean nothing.
constexpr double kStable = .01;
constexpr char kUnstable[] =
    "the simulated loop is unstable with this robot file's numbers and this "
    "controller's gains: give its joints their friction and armature, or look "
    "whether the gains are too high";

LoopValues FilesValues(const Robot& robot, const ControllerOptions& controller,
                       const OutputErrorOptions& options) {
  CoulombTransition transition;
  transition.width = options.coulomb_width;
  LoopValues values;
  values.arm.robot = robot;
  values.arm.transitions.assign(robot.links.size(), transition);
  values.drives = controller.drives;
  values.delay = controller.delay;
  // The same all through an estimate, whose cost would jump with them.
  values.substeps = EnoughSubsteps(values, controller.rate_hz);
  return values;
}

class Calibrator {
 public:
  Calibrator(const Robot& robot, const ControllerOptions& controller,
             const OutputErrorOptions& options,
             const std::vector<CommandedLog>& training,
             const TorqueInformation* torques)
      : options_(options),
        torques_(torques),
        kind_(controller.kind),
        files_(FilesValues(robot, controller, options)),
        windows_(robot, controller, options.window_s, training) {}

  OutputErrorCalibration Run() {
    result_.values = files_;
    result_.arm.robot = result_.arm.nominal = files_.arm.robot;
    result_.positions.noise = windows_.noise();
    run_ = windows_.Simulate(files_);
    result_.positions.nominal = windows_.ResidualRms(run_);
    if (!run_.finite) {
      result_.arm.reason = kUnstable;
      return result_;
    }
    if (torques_ != nullptr && !torques_->reason.empty()) {
      result_.arm.reason = "the logs with torques: " + torques_->reason;
      return result_;
    }
    unknowns_.emplace(files_, kind_, options_.trust, options_.joint_terms,
                      run_.torque_rms);
    columns_.emplace(files_.arm.robot, unknowns_->free());
    fit_.emplace(*unknowns_, options_.trust, torques_);
    Approach();
    Iterate(false, &windows_);
    if (!result_.arm.solved) return result_;
    x_ = unknowns_->ToBounds(x_);
    result_.values = unknowns_->At(x_);
    result_.arm.robot = result_.values.arm.robot;
    result_.positions.calibrated = windows_.ResidualRms(run_);
    Report();
    return result_;
  }

 private:
  // The file's values, or what torques say where they say it.
  VectorXd Start() const;
  // Near the bottom; run_ is of the file's values.
  void Approach();
  void Iterate(bool far, LoopWindows* windows);
  // Towards x, as far as the cost falls; false where it does not.
  bool Step(const VectorXd& x, LoopWindows* windows);
  void Report();
  void Tell(const std::string& stage, double fraction) const {
    if (options_.progress) options_.progress(stage, fraction);
  }

  const OutputErrorOptions& options_;
  const TorqueInformation* torques_;
  DriveKind kind_;
  LoopValues files_;
  LoopWindows windows_;
  std::optional<LoopUnknowns> unknowns_;
  std::optional<LoopColumns> columns_;
  std::optional<LoopFit> fit_;
  VectorXd x_;
  double excess_ = 1;        // of noise that the residuals of now count as
  LoopRun run_;              // at x_
  LoopEquations equations_;  // likewise
  OutputErrorCalibration result_;
};

VectorXd Calibrator::Start() const {
  VectorXd x = unknowns_->nominal();
  if (torques_ == nullptr) return x;
  for (int k = 0; k < torques_->x.size(); ++k) {
    if (unknowns_->is_free(k)) x[k] = torques_->x[k];
  }
  return x;
}

// Comes near the bottom by a few short windows, which are nearer to linear and
// cost less. From there, or from the file's values where that went astray, the
// whole is iterated.
void Calibrator::Approach() {
  LoopRun of_files = std::move(run_);
  x_ = Start();
  LoopWindows few = windows_.Thinned(kFewWindow, kFew);
  run_ = few.Simulate(unknowns_->At(x_));
  if (run_.finite) Iterate(true, &few);
  run_ = windows_.Simulate(unknowns_->At(x_));
  if (run_.finite) return;
  x_ = unknowns_->nominal();
  run_ = std::move(of_files);
}

// Halves the step until the cost falls (all windows simulated anew).
bool Calibrator::Step(const VectorXd& x, LoopWindows* windows) {
  const VectorXd begin = x_, dx = x - x_;
  const auto cost_of = [&](const LoopRun& run) {
    return run.cost / (excess_ * excess_) + fit_->PriorCost(x_);
  };
  const double cost = cost_of(run_);
  double share = 1;
  for (int k = 0; k < kMostHalvings; ++k, share /= 2) {
    // Bodies between two that can exist can exist.
    x_ = begin + share * dx;
    windows->Move(*columns_, equations_, dx, share);
    LoopRun next = windows->Simulate(unknowns_->At(x_));
    if (!next.finite || !(cost_of(next) < cost)) continue;
    run_ = std::move(next);
    return true;
  }
  x_ = begin;
  windows->Move(*columns_, equations_, 0 * dx, 0);
  return false;
}

// Gauss-Newton: linearise, solve the convex problem of the linear equations and
// the prior, step. Far from the bottom residuals are model error and not noise;
// they count by their own size (excess_) then, or the prior would be nothing
// beside them and bodies would be driven to the boundary.
void Calibrator::Iterate(bool far, LoopWindows* windows) {
  const double last = far ? kNear : kNearer;
  const double size = std::sqrt(static_cast<double>(unknowns_->size()));
  result_.arm.solved = false;
  result_.arm.reason = "NO_CONVERGENCE";
  for (int k = 0; k < kMostDescents; ++k) {
    Tell("simulating", -1);
    excess_ = far ? std::max(1., run_.Excess()) : 1;
    equations_ = windows->Linearise(unknowns_->At(x_), *columns_, run_);
    const MatrixXd R = equations_.R / excess_;
    VectorXd x = x_;
    if (!fit_->Solve(R, equations_.z / excess_ + R * x_, &x)) {
      result_.arm.reason = "the numbers of the logs overflow";
      return;
    }
    result_.arm.solved = true;
    ++result_.arm.iterations;
    const double moved = std::hypot((R * (x - x_)).norm(),
                                    (fit_->TorqueRows() * (x - x_)).norm()) /
                         size;
    const bool falls = Step(x, windows);
    // At the bottom rounding decides whether the cost still falls.
    if (moved < (falls ? 1 : 2) * last) result_.arm.reason = "CONVERGENCE";
    if (!falls || moved < last) return;
  }
}

// The sandwich G (noise's scores + torques' scores + prior) G, as in
// arm_covariance.cc. Noise's scores are multiplied by what residuals have in
// excess of noise; deviations are raised to the scatter of scores summed over a
// second each, which tells what else moves from second to second.
void Calibrator::Report() {
  Tell("covariance", -1);
  const std::vector<int> free = unknowns_->FreeIndices();
  const LoopScores scores =
      windows_.Scores(result_.values, *columns_, run_, equations_);
  const double excess = scores.residual_squares / scores.expected_squares;
  result_.model_error = std::sqrt(excess);
  const PositionFigures& positions = result_.positions;
  const bool off =
      (positions.calibrated.array() > positions.noise.array()).any();
  if (off && !(std::isfinite(scores.expected_squares) &&
               result_.model_error >= kStable)) {
    result_.values = files_;
    result_.arm.robot = files_.arm.robot;
    result_.arm.solved = false;
    result_.arm.reason = kUnstable;
    return;
  }
  const MatrixXd by_torque = fit_->TorqueRows();
  MatrixXd data(equations_.R.rows() + by_torque.rows(), by_torque.cols());
  data << equations_.R, by_torque;
  const auto trusting = [&](double inertia, double times) {
    return Posterior(data, fit_->PriorInformation(inertia, times), free);
  };
  const double inertia = options_.trust.inertia;
  const Posterior posterior = trusting(inertia, 1);
  const MatrixXd covariance =
      excess * posterior.Sandwich(SquareRoot(scores.covariance)) +
      posterior.Sandwich(SquareRoot(fit_->TorqueScores())) +
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
  std::vector<int> listed;
  for (int k = 0; k < unknowns_->size(); ++k) {
    if (!unknowns_->exists(k)) continue;
    listed.push_back(k);
    PhysicalParameter out;
    out.name = unknowns_->name(k);
    out.unit = unknowns_->unit(k);
    out.value = x_[k];
    out.prior = unknowns_->nominal()[k];
    out.held = !unknowns_->is_free(k);
    out.geometry = false;
    out.identifiable = !out.held && untrusted[k] < 2 * trusted[k];
    out.at_bound = unknowns_->IsAtBound(k, x_);
    out.stddev = out.identifiable ? std::sqrt(raised(k, k))
                                  : std::numeric_limits<double>::infinity();
    arm.parameters.push_back(out);
  }
  arm.covariance = raised(listed, listed);
  std::vector<std::string> names;
  for (const int k : free) names.push_back(unknowns_->name(k));
  const MatrixXd nothing = MatrixXd::Zero(0, unknowns_->size());
  arm.unseen = UnseenCombinations(
      free, names, data,
      Posterior(nothing, fit_->PriorInformation(1, 1), free).Gain().diagonal());
}

}  // namespace

OutputErrorCalibration CalibrateOutputError(
    const Robot& robot, const ControllerOptions& controller,
    const OutputErrorOptions& options,
    const std::vector<CommandedLog>& training,
    const std::vector<CommandedLog>& validation,
    const TorqueInformation* torques) {
  OutputErrorCalibration result =
      Calibrator(robot, controller, options, training, torques).Run();
  if (!result.arm.solved) return result;
  const bool held_out = !validation.empty();
  if (!held_out && options.trace_bins == 0) return result;
  const LoopWindows windows(robot, controller, options.window_s,
                            held_out ? validation : training);
  const std::vector<LoopRun> runs = {
      windows.Simulate(FilesValues(robot, controller, options)),
      windows.Simulate(result.values)};
  if (held_out) {
    result.positions.nominal_validation = windows.ResidualRms(runs[0]);
    result.positions.validation = windows.ResidualRms(runs[1]);
  }
  if (options.trace_bins == 0) return result;
  result.traces = TracePositions(windows, runs, options.trace_bins);
  return result;
}

}  // namespace armcal
