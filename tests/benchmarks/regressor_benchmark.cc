#include <benchmark/benchmark.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "model/dynamics/batch_inverse_dynamics.h"
#include "model/dynamics/batch_regressor.h"
#include "model/dynamics/regressor_plan.h"
#include "tests/fixtures/benchmark_log.h"

// Regressors and torques over batches of samples, and sample by sample.
// Counters: seconds per sample; and flops per second, counted as the fewest
// that the 60 columns of a 6R arm's links need (2049; 1242 of the torques), to
// compare with FmaPeak.

namespace armcal {
namespace {

constexpr int kSamples = 4096;
constexpr int kChunk = 256;  // rows of the matrices that are filled
constexpr double kRegressorFlops = 2049, kTorqueFlops = 1242;

struct Arm {
  Arm() : robot(BenchmarkRobot()), log(BenchmarkLog(robot, kSamples)) {
    ModelParameters::Options options;
    options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb};
    options.transitions.assign(robot.links.size(), {CoulombTransition()});
    parameters = std::make_unique<ModelParameters>(robot, options);
    coulomb = log.qd;
  }
  MotionColumns Motion(long first) const {
    return {log.q, log.qd, log.qdd, coulomb, first};
  }
  Robot robot;
  Log log;
  std::unique_ptr<ModelParameters> parameters;
  Eigen::MatrixXd coulomb;
};

const Arm& TheArm() {
  static const Arm arm;
  return arm;
}

// Matrices for `rows` samples of each joint's columns, on borders of cache
// lines.
class Matrices {
 public:
  Matrices(const BatchRegressor& regressor, long rows) {
    for (int i = 0; i < regressor.num_joints(); ++i) {
      const size_t bytes = rows * regressor.row_size(i) * sizeof(double);
      values_.emplace_back(
          static_cast<double*>(std::aligned_alloc(64, (bytes + 63) / 64 * 64)),
          std::free);
      pointers_.push_back(values_.back().get());
    }
  }
  double* const* out() const { return pointers_.data(); }

 private:
  std::vector<std::unique_ptr<double, void (*)(void*)>> values_;
  std::vector<double*> pointers_;
};

void SetCounters(benchmark::State& state, long samples, double flops) {
  const double all = static_cast<double>(samples);
  using benchmark::Counter;
  state.counters["per_sample"] =
      Counter(all, Counter::kIsIterationInvariantRate | Counter::kInvert);
  if (flops > 0) {
    state.counters["flops"] =
        Counter(all * flops, Counter::kIsIterationInvariantRate);
  }
}

// Fills matrices of `rows` rows again and again.
void Differential(benchmark::State& state, const BatchRegressor& regressor,
                  long rows, double flops) {
  const Matrices U(regressor, rows);
  std::vector<MotionColumns> motions;
  for (long first = 0; first + rows <= kSamples; first += rows) {
    motions.push_back(TheArm().Motion(first));
  }
  for (auto _ : state) {
    for (const MotionColumns& motion : motions) {
      regressor.Differential(motion, rows, U.out(), rows);
      benchmark::ClobberMemory();
    }
  }
  SetCounters(state, kSamples, flops);
}

void Momentum(benchmark::State& state, const BatchRegressor& regressor) {
  const Matrices P(regressor, kChunk), D(regressor, kChunk);
  for (auto _ : state) {
    for (long first = 0; first < kSamples; first += kChunk) {
      regressor.Momentum(TheArm().Motion(first), kChunk, P.out(), D.out(),
                         kChunk);
      benchmark::ClobberMemory();
    }
  }
  SetCounters(state, kSamples, 0);
}

void Torque(benchmark::State& state, const BatchInverseDynamics& dynamics) {
  Eigen::MatrixXd tau(kSamples, TheArm().robot.num_joints());
  std::vector<double*> columns;
  for (int j = 0; j < tau.cols(); ++j) columns.push_back(tau.col(j).data());
  for (auto _ : state) {
    dynamics.Torque(TheArm().Motion(0), kSamples, columns.data());
    benchmark::ClobberMemory();
  }
  SetCounters(state, kSamples, kTorqueFlops);
}

void SineCosine(benchmark::State& state, const simd::Kernels* kernels) {
  const Eigen::MatrixXd& q = TheArm().log.q;
  Eigen::MatrixXd sine = q, cosine = q;
  for (auto _ : state) {
    kernels->sine_cosine(q.data(), q.size(), sine.data(), cosine.data());
    benchmark::ClobberMemory();
  }
  SetCounters(state, kSamples, 0);
}

// One sample at a time into a dense matrix.
void LinksOfOne(benchmark::State& state, const simd::Kernels* kernels) {
  const RegressorPlan plan(TheArm().robot, RegressorPlan::Places::kNumbers);
  const int n = plan.num_joints();
  std::vector<MotionColumns> motions;
  for (int s = 0; s < 64; ++s) motions.push_back(TheArm().Motion(60 * s));
  Eigen::MatrixXd U = Eigen::MatrixXd::Zero(n, 10 * n);
  std::vector<double*> rows;
  for (int i = 0; i < n; ++i) rows.push_back(U.data() + i);
  size_t s = 0;
  for (auto _ : state) {
    const MotionColumns& motion = motions[s++ % motions.size()];
    kernels->differential_of_one(
        plan.paths()[0].chain,
        {motion.q.data(), motion.qd.data(), motion.qdd.data()}, 0, rows.data(),
        n);
    benchmark::ClobberMemory();
  }
  SetCounters(state, 1, kRegressorFlops);
}

// As the callers of Regressor hold it.
void OneSample(benchmark::State& state, bool momentum) {
  Regressor regressor = TheArm().parameters->MakeRegressor();
  const Log& log = TheArm().log;
  Eigen::MatrixXd U, D;
  int s = 0;
  for (auto _ : state) {
    const Eigen::VectorXd q = log.q.row(s), qd = log.qd.row(s);
    if (momentum) {
      regressor.Momentum(q, qd, qd, &U, &D);
    } else {
      regressor.Differential(q, qd, log.qdd.row(s), qd, &U);
    }
    benchmark::DoNotOptimize(U.data());
    s = (s + 1) % kSamples;
  }
  SetCounters(state, 1, 0);
}

void Register(const simd::Kernels* kernels) {
  const auto add = [&](const std::string& name, const auto& run) {
    benchmark::RegisterBenchmark(
        (name + "/" + kernels->instruction_set).c_str(), run);
  };
  const auto links = [=] { return BatchRegressor(TheArm().robot, *kernels); };
  const auto model = [=] {
    return BatchRegressor(*TheArm().parameters, *kernels);
  };
  add("SineCosine", [=](auto& state) { SineCosine(state, kernels); });
  add("LinkColumns", [=](auto& state) {
    Differential(state, links(), kChunk, kRegressorFlops);
  });
  add("LinkColumnsInL1", [=](auto& state) {
    Differential(state, links(), kernels->lanes, kRegressorFlops);
  });
  add("ModelColumns",
      [=](auto& state) { Differential(state, model(), kChunk, 0); });
  add("ModelMomentum", [=](auto& state) { Momentum(state, model()); });
  add("LinkMomentum", [=](auto& state) { Momentum(state, links()); });
  add("LinkColumnsOfOne", [=](auto& state) { LinksOfOne(state, kernels); });
  add("Torque", [=](auto& state) {
    Torque(state, BatchInverseDynamics(TheArm().robot, *kernels));
  });
}

const bool registered = [] {
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    Register(kernels);
  }
  for (const bool momentum : {false, true}) {
    benchmark::RegisterBenchmark(
        momentum ? "RegressorMomentum" : "RegressorDifferential",
        [=](auto& state) { OneSample(state, momentum); });
  }
  return true;
}();

}  // namespace
}  // namespace armcal
