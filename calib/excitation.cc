#include "calib/excitation.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "problems/motion_design.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSamplesPerWave = 16;  // of the highest harmonic
constexpr double kMargin = .98;      // peaks lie between samples
constexpr double kCheckRate = 1000;  // Hz

double Random(std::mt19937_64* random) {
  return 2 * static_cast<double>((*random)() >> 11) * 0x1p-53 - 1;
}

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
    // Peaks between samples may need more room than the margin.
    double margin = kMargin;
    for (int attempt = 0; attempt < 3; ++attempt) {
      Improve(options_.limits.Within(margin));
      result_.used = Used();
      if (result_.used <= 1) break;
      margin *= kMargin / result_.used;
      if (!ShrinkInto(options_.limits.Within(margin))) break;
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

  bool Start() {
    const MotionLimits inner = options_.limits.Within(kMargin * .97);
    std::optional<double> best;
    for (int k = 0; k < options_.starts; ++k) {
      const MatrixXd numbers =
          RandomNumbers(result_.basis, units_, inner, x_,
                        options_.seed * 1000003 + k, &information_);
      if (numbers.size() == 0) continue;
      const std::optional<double> value = Criterion(numbers);
      if (!value || (best && *value >= *best)) continue;
      best = value;
      result_.numbers = numbers;
    }
    result_.start = best.value_or(0);
    return best.has_value();
  }

  void Improve(const MotionLimits& limits) {
    constexpr double kBarriers[] = {.02, .004, .0008, .0002};
    auto* design =
        new MotionDesign(units_, limits, quantities_, options_.criterion,
                         weight_, x_, &information_);
    const ceres::GradientProblem problem(design);
    ceres::GradientProblemSolver::Options solver;
    solver.max_num_iterations = 200;
    solver.max_lbfgs_rank = 30;
    solver.function_tolerance = 1e-6;
    solver.gradient_tolerance = 1e-7;
    solver.logging_type = ceres::SILENT;
    ceres::GradientProblemSolver::Summary summary;
    int stage = 0;
    for (const double barrier : kBarriers) {
      design->SetBarrier(barrier);
      if (options_.progress) {
        options_.progress("designing the motion", ++stage / 5.);
      }
      ceres::Solve(solver, problem, result_.numbers.data(), &summary);
      result_.iterations += static_cast<int>(summary.iterations.size());
    }
    result_.converged = summary.IsSolutionUsable();
    result_.reason = summary.message;
  }

  double Used() {
    const auto samples =
        static_cast<int>(std::lround(result_.basis.period() * kCheckRate));
    const Motion motion =
        Combine(result_.basis.Units(samples, 1 / kCheckRate), result_.numbers);
    information_.Evaluate(motion, weight_);
    return options_.limits.Used(motion, information_.Torque(x_));
  }

  // Makes the motion smaller until it is within.
  bool ShrinkInto(const MotionLimits& limits) {
    for (int attempt = 0; attempt < 40; ++attempt) {
      const Motion motion = Combine(units_, result_.numbers);
      information_.Evaluate(motion, weight_);
      if (limits.Used(motion, information_.Torque(x_)) < 1) return true;
      result_.numbers.bottomRows(result_.numbers.rows() - 1) *= .97;
    }
    return false;
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

MatrixXd RandomNumbers(const HarmonicBasis& basis, const Motion& units,
                       const MotionLimits& limits, const VectorXd& x,
                       std::uint64_t seed, MotionInformation* information) {
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
  // All of them as torques allow.
  for (int attempt = 0; attempt < 40; ++attempt) {
    const Motion motion = Combine(units, numbers);
    information->Evaluate(motion, VectorXd::Ones(n));
    if (limits.Used(motion, information->Torque(x)) <= 1 + 1e-9) return numbers;
    numbers.bottomRows(basis.size() - 1) *= .9;
  }
  return {};
}

Excitation DesignExcitation(const Robot& robot, const ModelParameters& model,
                            const DesignQuantities& quantities,
                            const ExcitationOptions& options) {
  return Designer(robot, model, quantities, options).Run();
}

}  // namespace armcal
