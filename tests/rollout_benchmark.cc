// Forward dynamics and Runge-Kutta steps of the benchmarks' arm, in lanes and
// one by one. Counters: seconds per sample or step; `error`, by the measure of
// the other engines.

#include <benchmark/benchmark.h>

#include <string>

#include "model/arm_stepper.h"
#include "model/batch_forward_dynamics.h"
#include "model/batch_rollout.h"
#include "model/forward_dynamics.h"
#include "tests/benchmark_log.h"
#include "tests/free_fall.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSamples = 1000, kWindows = 64;

const FreeFall& Fall() {
  static const FreeFall fall;
  return fall;
}

void SetCounters(benchmark::State& state, double samples, double error) {
  using benchmark::Counter;
  state.counters["per_sample"] =
      Counter(samples, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["error"] = error;
}

// Error: of qdd, relative to the largest.
void Acceleration(benchmark::State& state, const simd::Kernels* kernels) {
  const Robot& robot = Fall().robot;
  const Log log = BenchmarkLog(robot, kSamples);
  const BatchForwardDynamics dynamics(robot, *kernels);
  MatrixXd qdd;
  for (auto _ : state) {
    dynamics.Acceleration(log.q, log.qd, log.tau, &qdd);
    benchmark::ClobberMemory();
  }
  SetCounters(state, kSamples,
              (qdd - log.qdd).lpNorm<Eigen::Infinity>() /
                  log.qdd.lpNorm<Eigen::Infinity>());
}

// Error: relative to the largest element.
void Inertia(benchmark::State& state, const simd::Kernels* kernels) {
  const Robot& robot = Fall().robot;
  const Log log = BenchmarkLog(robot, kSamples);
  const BatchForwardDynamics dynamics(robot, *kernels);
  MatrixXd M;
  for (auto _ : state) {
    dynamics.MassMatrix(log.q, &M);
    benchmark::ClobberMemory();
  }
  double error = 0;
  for (int s = 0; s < kSamples; ++s) {
    const MatrixXd expected = MassMatrix(robot, log.q.row(s));
    const Eigen::Map<const VectorXd> flat(expected.data(), expected.size());
    error = std::max(error,
                     (M.row(s).transpose() - flat).lpNorm<Eigen::Infinity>() /
                         flat.lpNorm<Eigen::Infinity>());
  }
  SetCounters(state, kSamples, error);
}

RolloutArm Arm(bool friction) {
  RolloutArm arm{Fall().robot, {}, {}};
  for (Link& link : arm.robot.links) {
    link.joint.viscous = friction ? 2 : 0;
    link.joint.coulomb = friction ? 1 : 0;
  }
  return arm;
}

void HoldNothing(const BatchRollout::Batch& at, double* begin, double* end) {
  for (int j = 0; j < Fall().robot.num_joints(); ++j) {
    for (int k = 0; k < at.count; ++k) {
      begin[j * at.stride + k] = end[j * at.stride + k] = 0;
    }
  }
}

// Error: of q at the end of the fall, rad; none with friction.
void Windows(benchmark::State& state, const simd::Kernels* kernels,
             bool friction) {
  const BatchRollout rollout({Arm(friction)}, *kernels);
  RolloutStates states;
  for (auto _ : state) {
    states.q = Fall().q.transpose().replicate(kWindows, 1);
    states.qd = Fall().qd.transpose().replicate(kWindows, 1);
    states.coulomb.resize(0, 0);
    rollout.Run(0, FreeFall::kStep, FreeFall::kSteps, HoldNothing, nullptr,
                &states);
  }
  SetCounters(state, 1. * kWindows * FreeFall::kSteps,
              friction ? 0 : Fall().Error(states.q.row(0)));
}

void OneArm(benchmark::State& state, const simd::Kernels* kernels,
            bool friction) {
  ArmStepper arm(Arm(friction), *kernels);
  const VectorXd none = VectorXd::Zero(arm.num_joints());
  for (auto _ : state) {
    arm.SetState(Fall().q, Fall().qd);
    for (int k = 0; k < FreeFall::kSteps; ++k) {
      arm.Advance(FreeFall::kStep, none, none);
    }
  }
  SetCounters(state, FreeFall::kSteps, friction ? 0 : Fall().Error(arm.q()));
}

// The readable one, which allocates.
void Readable(benchmark::State& state) {
  const Robot& robot = Fall().robot;
  const VectorXd none = VectorXd::Zero(robot.num_joints());
  for (auto _ : state) {
    benchmark::DoNotOptimize(ForwardDynamics(robot, Fall().q, Fall().qd, none));
  }
  SetCounters(state, 1, 0);
}
BENCHMARK(Readable)->Name("ForwardDynamics/readable");

const bool registered = [] {
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    const auto add = [&](const std::string& name, const auto& run) {
      benchmark::RegisterBenchmark(
          (name + "/" + kernels->instruction_set).c_str(), run);
    };
    add("ForwardDynamics/lanes", [=](auto& s) { Acceleration(s, kernels); });
    add("MassMatrix/lanes", [=](auto& s) { Inertia(s, kernels); });
    add("Rollout/lanes", [=](auto& s) { Windows(s, kernels, false); });
    add("Rollout/lanes_friction", [=](auto& s) { Windows(s, kernels, true); });
    add("Rollout/scalar", [=](auto& s) { OneArm(s, kernels, false); });
    add("Rollout/scalar_friction", [=](auto& s) { OneArm(s, kernels, true); });
  }
  return true;
}();

}  // namespace
}  // namespace armcal
