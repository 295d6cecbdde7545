// The Jacobian of torques by inertial and geometric parameters, and what a
// nonlinear calibration does with it, on the problem that ceres_benchmark.cc
// gives to Ceres.

#include <benchmark/benchmark.h>

#include <cmath>
#include <numeric>
#include <string>

#include "calib/linear/robust_reduction.h"
#include "calib/numerics/thread_limit.h"
#include "model/dynamics/regressor_plan.h"
#include "problems/weak_rows.h"
#include "tests/benchmarks/compressed_solution.h"
#include "tests/fixtures/benchmark_log.h"

namespace armcal {
namespace {

constexpr int kSamples = 10000;
constexpr int kChunk = 256;  // rows of the matrices that are filled
constexpr int kJoints = SixAxisProblem::kJoints;
constexpr int kInertial = SixAxisProblem::kInertial;
constexpr int kGeometric = SixAxisProblem::kGeometric;

const CompressedSolution& TheProblem() {
  static const CompressedSolution problem((SixAxisProblem(kSamples)));
  return problem;
}

MotionColumns Motion(long first) {
  const Trajectory& t = TheProblem().trajectory();
  return {t.q, t.qd, t.qdd, {}, first};
}

GeometryJacobian MakeJacobian(const simd::Kernels& kernels) {
  const CompressedSolution& p = TheProblem();
  return GeometryJacobian(p.WithInertia(p.x()), p.Geometry(p.x()), p.refined(),
                          kernels);
}

Robot TheRobot() {
  const CompressedSolution& p = TheProblem();
  return p.Geometry(p.x()).ApplyTo(p.WithInertia(p.x()));
}

// Torques of chunks, or P and D.
void JacobianOfChunks(benchmark::State& state, const simd::Kernels& kernels,
                      bool momentum) {
  const BatchRegressor regressor(TheRobot(), kernels);
  const GeometryJacobian jacobian = MakeJacobian(kernels);
  std::vector<int> sizes;
  for (int i = 0; i < kJoints; ++i) {
    sizes.push_back(regressor.row_size(i) + kGeometric);
  }
  JointColumns U, D;
  U.Resize(sizes, kChunk);
  D.Resize(sizes, kChunk);
  std::vector<double*> of_U, of_D;  // geometry's columns
  for (int i = 0; i < kJoints; ++i) {
    of_U.push_back(U.column(i, regressor.row_size(i)));
    of_D.push_back(D.column(i, regressor.row_size(i)));
  }
  std::vector<MotionColumns> motions;
  for (long k = 0; k + kChunk <= kSamples; k += kChunk) {
    motions.push_back(Motion(k));
  }
  for (auto _ : state) {
    for (const MotionColumns& motion : motions) {
      if (momentum) {
        regressor.Momentum(motion, kChunk, U.data(), D.data(), U.stride());
        jacobian.Momentum(motion, kChunk, of_U.data(), of_D.data(), U.stride());
      } else {
        regressor.Differential(motion, kChunk, U.data(), U.stride());
        jacobian.Torque(motion, kChunk, of_U.data(), U.stride());
      }
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * kChunk *
                          static_cast<long>(motions.size()));
}

// One sample after the other, into dense matrices.
void JacobianOfOne(benchmark::State& state) {
  const simd::Kernels& kernels = simd::BestKernels();
  const RegressorPlan plan(TheRobot(), RegressorPlan::Places::kNumbers);
  const GeometryJacobian jacobian = MakeJacobian(kernels);
  Eigen::MatrixXd U = Eigen::MatrixXd::Zero(kJoints, kInertial), G;
  std::vector<double*> rows;
  for (int i = 0; i < kJoints; ++i) rows.push_back(U.data() + i);
  const Trajectory& t = TheProblem().trajectory();
  std::vector<MotionColumns> motions;
  std::vector<Eigen::VectorXd> q, qd, qdd;
  for (int k = 0; k < 64; ++k) {
    motions.push_back(Motion(k));
    q.push_back(t.q.row(k));
    qd.push_back(t.qd.row(k));
    qdd.push_back(t.qdd.row(k));
  }
  size_t k = 0;
  for (auto _ : state) {
    const MotionColumns& at = motions[k];
    kernels.differential_of_one(plan.paths()[0].chain,
                                {at.q.data(), at.qd.data(), at.qdd.data()}, 0,
                                rows.data(), kJoints);
    G = jacobian.Torque(q[k], qd[k], qdd[k]);
    benchmark::DoNotOptimize(G.data());
    benchmark::ClobberMemory();
    k = (k + 1) % motions.size();
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(JacobianOfOne)->Name("Jacobian/scalar");

// From the same start again and again, a little off the truth.
void Iteration(benchmark::State& state) {
  const ThreadLimit one(1);
  CompressedSolution solution = TheProblem();
  const Eigen::VectorXd start =
      solution.x() + Eigen::VectorXd::Constant(kInertial + kGeometric, 1e-3);
  for (auto _ : state) {
    state.PauseTiming();
    solution.Start(start);  // its cost is the last iteration's work
    state.ResumeTiming();
    if (!solution.Iterate()) state.SkipWithError("no step");
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(Iteration)->Name("Nonlinear/iteration");

void Covariance(benchmark::State& state) {
  const ThreadLimit one(1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(TheProblem().Covariance());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(Covariance)->Name("Nonlinear/covariance");

// The equations of `calibrate`: weak rows of a log of as many steps, with every
// parameter of the arm's own geometry, weighted by Huber's loss.
void WeakIteration(benchmark::State& state) {
  const ThreadLimit one(1);
  const Robot robot = BenchmarkRobot();
  const Log log = BenchmarkLog(robot, kSamples);
  Trajectory t;
  t.dt = 1e-3;
  t.q = log.q;
  t.qd = log.qd;
  t.qdd = log.qdd;
  t.tau = log.tau;
  t.standstill.setConstant(t.size(), false);
  t.core_end = t.size();
  const ArmGeometry geometry(robot);
  std::vector<int> refined(geometry.size() - 12);
  std::iota(refined.begin(), refined.end(), 6);
  for (auto _ : state) {
    LinkFunctions functions(robot, {}, geometry, refined);
    functions.Enter(t);
    Eigen::VectorXd x(functions.size());
    x << StackInertials(robot), geometry.Values()(refined);
    RobustReduction reduction(
        {x, static_cast<int>(refined.size()),
         Eigen::VectorXd::Ones(robot.num_joints()), RobustLoss::kHuber},
        functions, RowsPerLeaf({}));
    reduction.Add(WeakRows(t, {}, functions),
                  std::vector<bool>(robot.num_joints(), true));
    benchmark::DoNotOptimize(reduction.Triangle());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(WeakIteration)->Name("Nonlinear/iteration_s");

const bool registered = [] {
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    for (const bool momentum : {false, true}) {
      benchmark::RegisterBenchmark(
          (std::string("Jacobian/") + (momentum ? "momentum/" : "chunk/") +
           kernels->instruction_set)
              .c_str(),
          [=](auto& state) { JacobianOfChunks(state, *kernels, momentum); });
    }
  }
  return true;
}();

}  // namespace
}  // namespace armcal
