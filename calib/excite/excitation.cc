#include "calib/excite/excitation.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "model/text/uniform_draw.h"
#include "problems/motion_design.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSamplesPerWave = 16;  // of the highest harmonic
constexpr double kMargin = .98;      // peaks lie between samples
constexpr double kClearance = .01;   // m, for the same reason
constexpr double kCheckRate = 1000;  // Hz
constexpr int kMostTries = 20;       // of random motions, for one that is clear

double Random(std::mt19937_64* random) { return 2 * UniformDraw(random) - 1; }

class Designer {
 public:
  Designer(const Robot& robot, const ModelParameters& model,
           const DesignQuantities& quantities, const ExcitationOptions& options)
      : quantities_(quantities),
        options_(options),
        x_(model.Values(robot)),
        information_(robot, model) {
    const double period = options.duration_s / options.periods;
    const int samples = kSamplesPerWave * options.harmonics;
    result_.basis = HarmonicBasis(period, options.harmonics);
    units_ = result_.basis.Units(samples, period / samples);
    weight_ = options.torque_noise.cwiseAbs2().cwiseInverse() *
              (options.duration_s * options.rate_hz / samples);
  }

  Excitation Run() {
    if (!Start()) {
      result_.reason = "no motion within the limits tells all that is asked";
      return result_;
    }
    // Peaks between samples may need more room than the margins.
    double margin = kMargin, clearance = kClearance;
    for (int attempt = 0; attempt < 3; ++attempt) {
      ImproveFromBoth(Bounds(margin, clearance));
      CheckBounds(options_, x_, &information_, &result_);
      if (result_.used <= 1 && result_.clearance >= 0) break;
      margin *= kMargin / std::max(kMargin, result_.used);
      clearance += std::max(0., -result_.clearance);
      if (!ShrinkInto(Bounds(.99 * margin, 1.1 * clearance))) break;
    }
    Describe();
    return result_;
  }

 private:
  std::optional<double> Criterion(const MatrixXd& numbers) {
    information_.Evaluate(Combine(units_, numbers), weight_);
    MatrixXd of_A;
    return EvaluateCriterion(options_.criterion, quantities_, information_.A(),
                             &of_A);
  }

  MotionBounds Bounds(double share, double clearance) const {
    return {options_.limits.Within(share), &options_.workspace, clearance};
  }

  bool Start() {
    const MotionBounds inner = Bounds(kMargin * .97, 1.5 * kClearance);
    std::optional<double> best;
    int found = 0;
    for (int k = 0; k < kMostTries * options_.starts; ++k) {
      const MatrixXd numbers =
          RandomNumbers(result_.basis, units_, inner, x_,
                        options_.seed * 1000003 + k, &information_);
      if (numbers.size() == 0) continue;
      if (++found > options_.starts) break;
      const std::optional<double> value = Criterion(numbers);
      if (!value || (best && *value >= *best)) continue;
      best = value;
      result_.numbers = numbers;
    }
    result_.start = best.value_or(0);
    return best.has_value();
  }

  // The sharper criteria have poorer optima nearby than the volume has: they
  // are improved from its design as well, and the better is kept.
  void ImproveFromBoth(const MotionBounds& bounds) {
    const MatrixXd start = result_.numbers;
    Improve(bounds, options_.criterion, 0);
    if (options_.criterion == ExcitationCriterion::kD) return;
    const Excitation direct = result_;
    const std::optional<double> value = Criterion(direct.numbers);
    result_.numbers = start;
    Improve(bounds, ExcitationCriterion::kD, .33);
    Improve(bounds, options_.criterion, .67);
    const std::optional<double> other = Criterion(result_.numbers);
    if (value && (!other || *value <= *other)) result_ = direct;
  }

  void Improve(const MotionBounds& bounds, ExcitationCriterion criterion,
               double share) {
    constexpr double kBarriers[] = {.02, .004, .0008, .0002};
    auto* design = new MotionDesign(units_, bounds, quantities_, criterion,
                                    weight_, x_, &information_);
    const ceres::GradientProblem problem(design);
    ceres::GradientProblemSolver::Options solver;
    solver.max_num_iterations = 200;
    solver.max_lbfgs_rank = 30;
    solver.function_tolerance = 1e-6;
    solver.gradient_tolerance = 1e-7;
    solver.logging_type = ceres::SILENT;
    ceres::GradientProblemSolver::Summary summary;
    const bool once = options_.criterion == ExcitationCriterion::kD;
    int stage = 0;
    for (const double barrier : kBarriers) {
      design->SetBarrier(barrier);
      if (options_.progress) {
        options_.progress("designing the motion",
                          share + (once ? 1 : .33) * ++stage / 5.);
      }
      ceres::Solve(solver, problem, result_.numbers.data(), &summary);
      result_.iterations += static_cast<int>(summary.iterations.size());
    }
    result_.converged = summary.IsSolutionUsable();
    result_.reason = summary.message;
  }

  bool ShrinkInto(const MotionBounds& bounds) {
    return ShrinkWaves(units_, bounds, x_, .97, &information_,
                       &result_.numbers);
  }

  void Describe() {
    result_.criterion = Criterion(result_.numbers)
                            .value_or(std::numeric_limits<double>::infinity());
    result_.stddev = PredictedStddev(quantities_, information_.A());
  }

  const DesignQuantities& quantities_;
  const ExcitationOptions& options_;
  VectorXd x_, weight_;
  MotionInformation information_;
  Motion units_;
  Excitation result_;
};

}  // namespace

bool ShrinkWaves(const Motion& units, const MotionBounds& bounds,
                 const VectorXd& x, double factor,
                 MotionInformation* information, MatrixXd* numbers) {
  for (int attempt = 0; attempt < 80; ++attempt) {
    const Motion motion = Combine(units, *numbers);
    if (bounds.workspace->Clearance(motion.q) > bounds.clearance) {
      information->Evaluate(motion, VectorXd::Ones(numbers->cols()));
      if (bounds.limits.Used(motion, information->Torque(x)) <= 1 + 1e-9) {
        return true;
      }
    }
    numbers->bottomRows(numbers->rows() - 1) *= factor;
  }
  return false;
}

void CheckBounds(const ExcitationOptions& options, const VectorXd& x,
                 MotionInformation* information, Excitation* motion) {
  const auto samples =
      static_cast<int>(std::lround(motion->basis.period() * kCheckRate));
  const Motion fine =
      Combine(motion->basis.Units(samples, 1 / kCheckRate), motion->numbers);
  information->Evaluate(fine, VectorXd::Ones(motion->numbers.cols()));
  motion->used = options.limits.Used(fine, information->Torque(x));
  motion->clearance = options.workspace.Clearance(fine.q);
}

MatrixXd RandomNumbers(const HarmonicBasis& basis, const Motion& units,
                       const MotionBounds& bounds, const VectorXd& x,
                       std::uint64_t seed, MotionInformation* information) {
  const MotionLimits& limits = bounds.limits;
  constexpr double kOffCentre = .3;  // at most, of half the range
  const Eigen::Index n = limits.velocity.size();
  std::mt19937_64 random(seed);
  MatrixXd numbers(basis.size(), n);
  for (double& number : numbers.reshaped()) number = Random(&random);
  // Each joint as large as its own limits allow, about a random centre.
  for (Eigen::Index j = 0; j < n; ++j) {
    auto waves = numbers.col(j).tail(basis.size() - 1);
    const auto reach = [&](const MatrixXd& of_units) {
      return (of_units.rightCols(basis.size() - 1) * waves)
          .cwiseAbs()
          .maxCoeff();
    };
    const double middle = (limits.upper[j] + limits.lower[j]) / 2;
    const double half = (limits.upper[j] - limits.lower[j]) / 2;
    const double off_centre = kOffCentre * numbers(0, j);
    waves *= std::min({(1 - std::abs(off_centre)) * half / reach(units.q),
                       limits.velocity[j] / reach(units.qd),
                       limits.acceleration[j] / reach(units.qdd)});
    numbers(0, j) = middle + off_centre * half;
  }
  // All of them as torques and the workspace allow.
  const MatrixXd centre = numbers.row(0);
  if (bounds.workspace->Clearance(centre) < bounds.clearance ||
      !ShrinkWaves(units, bounds, x, .9, information, &numbers)) {
    return {};
  }
  return numbers;
}

Excitation DesignExcitation(const Robot& robot, const ModelParameters& model,
                            const DesignQuantities& quantities,
                            const ExcitationOptions& options) {
  return Designer(robot, model, quantities, options).Run();
}

}  // namespace armcal
