// What the nonlinear calibration is measured by: Ceres as one uses it at first,
// a block of residuals per sample. Torques of a 6R arm with 60 inertial and 24
// geometric parameters.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/benchmarks/compressed_solution.h"
#include "tests/benchmarks/six_axis_blocks.h"

namespace armcal {
namespace {

constexpr int kJoints = SixAxisProblem::kJoints;
constexpr int kInertial = SixAxisProblem::kInertial;
constexpr int kGeometric = SixAxisProblem::kGeometric;
constexpr int kSamples = 10000;

// Largest difference of the torques to InverseDynamics', N m.
double Error(const SixAxisProblem& problem) {
  const Robot robot = problem.MakeRobot();
  double error = 0;
  for (int k = 0; k < 100; ++k) {
    const SixAxisSample& at = problem.samples[k];
    using State = Eigen::Map<const Eigen::VectorXd>;
    Eigen::VectorXd tau(kJoints);
    SixAxisTorque<double>().Evaluate(problem.inertial.data(),
                                     problem.geometric.data(), at, tau.data());
    tau -= InverseDynamics(robot, State(at.q, kJoints), State(at.qd, kJoints),
                           State(at.qdd, kJoints));
    error = std::max(error, tau.lpNorm<Eigen::Infinity>());
  }
  return error;
}

const SixAxisProblem& TheProblem() {
  static const SixAxisProblem problem(kSamples);
  return problem;
}

// One evaluation of residuals and Jacobian of a sample.
void AutoDiff(benchmark::State& state) {
  constexpr int kBlocks = 32;
  const SixAxisProblem& problem = TheProblem();
  std::vector<std::unique_ptr<SixAxisBlock>> blocks;
  for (int k = 0; k < kBlocks; ++k) {
    blocks.push_back(std::make_unique<SixAxisBlock>(
        new SixAxisResidual{problem.samples[k]}));
  }
  const double* x[] = {problem.inertial.data(), problem.geometric.data()};
  double residual[kJoints], of_inertial[kJoints * kInertial],
      of_geometric[kJoints * kGeometric];
  double* jacobian[] = {of_inertial, of_geometric};
  for (auto _ : state) {
    for (const auto& block : blocks) {
      block->Evaluate(x, residual, jacobian);
      benchmark::DoNotOptimize(of_geometric);
    }
  }
  state.SetItemsProcessed(state.iterations() * kBlocks);
  state.counters["error"] = Error(problem);
}
BENCHMARK(AutoDiff)->Name("Ceres/autodiff");

// Largest difference of our geometric columns to those, over the largest.
void Accuracy(benchmark::State& state, const simd::Kernels& kernels) {
  const SixAxisProblem& problem = TheProblem();
  const CompressedSolution ours(problem);
  const GeometryJacobian jacobian(ours.WithInertia(ours.x()),
                                  ours.Geometry(ours.x()), ours.refined(),
                                  kernels);
  constexpr int kCompared = 128;
  std::vector<Eigen::MatrixXd> rows(kJoints,
                                    Eigen::MatrixXd(kCompared, kGeometric));
  std::vector<double*> out;
  for (Eigen::MatrixXd& row : rows) out.push_back(row.data());
  const Trajectory& t = ours.trajectory();
  for (auto _ : state) {
    jacobian.Torque({t.q, t.qd, t.qdd, {}}, kCompared, out.data(), kCompared);
  }
  const double* x[] = {problem.inertial.data(), problem.geometric.data()};
  double error = 0, largest = 0;
  for (int k = 0; k < kCompared; ++k) {
    double residual[kJoints], expected[kJoints * kGeometric];
    double* of[] = {nullptr, expected};
    SixAxisBlock(new SixAxisResidual{problem.samples[k]})
        .Evaluate(x, residual, of);
    for (int e = 0; e < kJoints * kGeometric; ++e) {
      const double found = rows[e / kGeometric](k, e % kGeometric);
      error = std::max(error, std::abs(found - expected[e]));
      largest = std::max(largest, std::abs(expected[e]));
    }
  }
  state.counters["error"] = error / largest;
  state.SetItemsProcessed(state.iterations() * kCompared);
}
const bool registered = [] {
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    const auto name =
        std::string("Accuracy/Jacobian/chunk/") + kernels->instruction_set;
    benchmark::RegisterBenchmark(name.c_str(), [=](auto& state) {
      Accuracy(state, *kernels);
    })->Iterations(1);
  }
  return true;
}();

// A sample's residuals and Jacobian as they are at one point: what analytic
// derivatives would give, at no cost, so that what is timed is Ceres alone.
class StoredBlock
    : public ceres::SizedCostFunction<kJoints, kInertial, kGeometric> {
 public:
  StoredBlock(const SixAxisProblem& problem, const SixAxisSample& sample) {
    const double* x[] = {problem.inertial.data(), problem.geometric.data()};
    double* jacobian[] = {of_inertial_, of_geometric_};
    SixAxisBlock(new SixAxisResidual{sample}).Evaluate(x, residual_, jacobian);
  }

  bool Evaluate(double const* const* x, double* residual,
                double** jacobian) const override {
    (void)x;
    std::copy(residual_, residual_ + kJoints, residual);
    if (jacobian == nullptr) return true;
    if (jacobian[0] != nullptr) {
      std::copy(std::begin(of_inertial_), std::end(of_inertial_), jacobian[0]);
    }
    if (jacobian[1] != nullptr) {
      std::copy(std::begin(of_geometric_), std::end(of_geometric_),
                jacobian[1]);
    }
    return true;
  }

 private:
  double residual_[kJoints];
  double of_inertial_[kJoints * kInertial];
  double of_geometric_[kJoints * kGeometric];
};

struct BlockPerSample {
  BlockPerSample() : x(TheProblem()) {
    for (const SixAxisSample& sample : x.samples) {
      problem.AddResidualBlock(new StoredBlock(x, sample), nullptr,
                               x.inertial.data(), x.geometric.data());
    }
    AddSixAxisPriors(x, x.inertial.data(), x.geometric.data(), &problem);
  }

  SixAxisProblem x;
  ceres::Problem problem;
};

// Items are iterations: Jacobian, normal equations, step, cost.
void Iteration(benchmark::State& state) {
  BlockPerSample blocks;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 1;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  long evaluations = 0;
  for (auto _ : state) {
    ceres::Solver::Summary summary;
    ceres::Solve(options, &blocks.problem, &summary);
    evaluations += summary.num_jacobian_evaluations;
  }
  state.SetItemsProcessed(std::max(evaluations, 1L));
}
BENCHMARK(Iteration)->Name("Ceres/iteration")->Iterations(2)->Repetitions(5);

void SparseQrCovariance(benchmark::State& state) {
  BlockPerSample blocks;
  double* inertial = blocks.x.inertial.data();
  double* geometric = blocks.x.geometric.data();
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.num_threads = 1;
  for (auto _ : state) {
    ceres::Covariance covariance(options);
    if (!covariance.Compute({{inertial, inertial},
                             {inertial, geometric},
                             {geometric, geometric}},
                            &blocks.problem)) {
      state.SkipWithError("no covariance");
    }
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(SparseQrCovariance)
    ->Name("Ceres/covariance_sparse_qr")
    ->Iterations(1)
    ->Repetitions(3);

}  // namespace
}  // namespace armcal
