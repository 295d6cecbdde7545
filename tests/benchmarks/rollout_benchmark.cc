// Forward dynamics and Runge-Kutta steps of the benchmarks' arm, in lanes and
// one by one. Counters: seconds per sample or step; `error`, by the measure of
// the other engines.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

#include "model/dynamics/arm_stepper.h"
#include "model/dynamics/batch_forward_dynamics.h"
#include "model/dynamics/batch_rollout.h"
#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/benchmark_log.h"
#include "tests/fixtures/free_fall.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSamples = 1000, kWindows = 64;
constexpr double kViscous = .2;  // N m s/rad, as tests/peers has it

// Without friction; with viscous friction, in implicit steps.
const FreeFall& Fall(bool damped = false) {
  static const FreeFall free(0), with_friction(kViscous);
  return damped ? with_friction : free;
}

void SetCounters(benchmark::State& state, double samples, double error) {
  using benchmark::Counter;
  state.counters["per_sample"] =
      Counter(samples, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["error"] = error;
}

// Largest of what torque(s) misses at the samples of a log, relative to the
// largest torque.
template <class Torque>
double TorqueError(const Log& log, const Torque& torque) {
  double error = 0;
  for (int s = 0; s < kSamples; ++s) {
    const VectorXd missed = torque(s) - log.tau.row(s).transpose();
    error = std::max(error, missed.lpNorm<Eigen::Infinity>());
  }
  return error / log.tau.lpNorm<Eigen::Infinity>();
}

// Error: of the torque at the acceleration found.
void Acceleration(benchmark::State& state, const simd::Kernels* kernels) {
  const Robot& robot = Fall().robot;
  const Log log = BenchmarkLog(robot, kSamples);
  const BatchForwardDynamics dynamics(robot, *kernels);
  MatrixXd qdd;
  for (auto _ : state) {
    dynamics.Acceleration(log.q, log.qd, log.tau, &qdd);
    benchmark::ClobberMemory();
  }
  SetCounters(state, kSamples, TorqueError(log, [&](int s) {
                return InverseDynamics(robot, log.q.row(s), log.qd.row(s),
                                       qdd.row(s));
              }));
}

// Error: of the torque that the mass matrix makes of the acceleration.
void Inertia(benchmark::State& state, const simd::Kernels* kernels) {
  const Robot& robot = Fall().robot;
  const int n = robot.num_joints();
  const Log log = BenchmarkLog(robot, kSamples);
  const BatchForwardDynamics dynamics(robot, *kernels);
  MatrixXd M;
  for (auto _ : state) {
    dynamics.MassMatrix(log.q, &M);
    benchmark::ClobberMemory();
  }
  SetCounters(state, kSamples, TorqueError(log, [&](int s) -> VectorXd {
                const VectorXd row = M.row(s);
                return Eigen::Map<const MatrixXd>(row.data(), n, n) *
                           log.qdd.row(s).transpose() +
                       InverseDynamics(robot, log.q.row(s), log.qd.row(s),
                                       VectorXd::Zero(n));
              }));
}

// Of both kinds of falls, and of one with dry friction on top.
struct Kind {
  const char* name;
  bool damped;
  double coulomb;  // N m
};
constexpr Kind kKinds[] = {
    {"", false, 0}, {"_damped", true, 0}, {"_friction", true, 1}};

RolloutArm Arm(const Kind& kind) {
  RolloutArm arm{Fall(kind.damped).robot, {}, {}};
  for (Link& link : arm.robot.links) link.joint.coulomb = kind.coulomb;
  return arm;
}

// Of q at the end, rad; not looked at with dry friction.
double ErrorOf(const Kind& kind, const VectorXd& q) {
  return kind.coulomb > 0 ? 0 : Fall(kind.damped).Error(q);
}

void HoldNothing(const BatchRollout::Batch& at, double* begin, double* end) {
  for (int j = 0; j < Fall().robot.num_joints(); ++j) {
    for (int k = 0; k < at.count; ++k) {
      begin[j * at.stride + k] = end[j * at.stride + k] = 0;
    }
  }
}

void Windows(benchmark::State& state, const simd::Kernels* kernels,
             const Kind& kind) {
  const BatchRollout rollout({Arm(kind)}, *kernels);
  RolloutStates states;
  for (auto _ : state) {
    states.q = Fall().q.transpose().replicate(kWindows, 1);
    states.qd = Fall().qd.transpose().replicate(kWindows, 1);
    states.coulomb.resize(0, 0);
    rollout.Run(0, FreeFall::kStep, FreeFall::kSteps, HoldNothing, nullptr,
                &states);
  }
  SetCounters(state, 1. * kWindows * FreeFall::kSteps,
              ErrorOf(kind, states.q.row(0)));
}

void OneArm(benchmark::State& state, const simd::Kernels* kernels,
            const Kind& kind) {
  ArmStepper arm(Arm(kind), *kernels);
  const VectorXd none = VectorXd::Zero(arm.num_joints());
  for (auto _ : state) {
    arm.SetState(Fall().q, Fall().qd);
    for (int k = 0; k < FreeFall::kSteps; ++k) {
      arm.Advance(FreeFall::kStep, none, none);
    }
  }
  SetCounters(state, FreeFall::kSteps, ErrorOf(kind, arm.q()));
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
    for (const Kind& kind : kKinds) {
      const std::string name = kind.name;
      add("Rollout/lanes" + name, [=](auto& s) { Windows(s, kernels, kind); });
      add("Rollout/scalar" + name, [=](auto& s) { OneArm(s, kernels, kind); });
    }
  }
  return true;
}();

}  // namespace
}  // namespace armcal
