// Linear calibration of logs in memory, beside Eigen's QR of the whole.

#include <benchmark/benchmark.h>

#include <Eigen/QR>
#include <memory>
#include <string>

#include "calib/thread_limit.h"
#include "calib/triangular_factor.h"
#include "model/inverse_dynamics.h"
#include "model/simd/kernels.h"
#include "tests/benchmark_log.h"
#include "tests/in_memory_calibration.h"
#include "tests/sample_motion.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const ModelParameters& Parameters() {
  static const ModelParameters parameters = [] {
    const Robot robot = BenchmarkRobot();
    ModelParameters::Options options;
    options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb};
    options.transitions.assign(robot.num_joints(), {CoulombTransition()});
    return ModelParameters(robot, options);
  }();
  return parameters;
}

RowOptions Options(Identification identification) {
  RowOptions options;
  options.identification = identification;
  return options;
}

// The benchmarks' log with noise; the last one asked for is kept.
const Trajectory& BenchmarkTrajectory(long samples) {
  static Trajectory trajectory;
  if (trajectory.size() == samples) return trajectory;
  trajectory = Trajectory();
  trajectory = MakeTrajectory(BenchmarkLog(BenchmarkRobot(), samples));
  std::mt19937_64 random(1);
  AddNoise(&random, VectorXd::Constant(trajectory.num_joints(), .05),
           &trajectory.tau);
  return trajectory;
}

// Of 2 sum k_j^2: multiplications and additions of Householder QR, for each
// sample.
double QrFlops() {
  double flops = 0;
  for (int i = 0; i < Parameters().num_joints(); ++i) {
    const double k =
        static_cast<double>(Parameters().row_columns(i).size()) + 1;
    flops += 2 * k * k;
  }
  return flops;
}

void Calibrate(benchmark::State& state, Identification identification,
               long samples, int threads) {
  const Trajectory& log = BenchmarkTrajectory(samples);
  const ThreadLimit limit(threads);
  for (auto _ : state) {
    const InMemoryCalibration calibration(Parameters(), Options(identification),
                                          log);
    benchmark::DoNotOptimize(calibration.covariance.data());
  }
  state.SetItemsProcessed(state.iterations() * samples);
  state.counters["qr_flops"] = QrFlops();
}

// What one writes first: all equations in one matrix.
void DenseQr(benchmark::State& state, long samples) {
  const Trajectory& log = BenchmarkTrajectory(samples);
  const int m = Parameters().size(), n = log.num_joints();
  for (auto _ : state) {
    MatrixXd A = MatrixXd::Zero(n * samples, m + 1);
    MotionRegressor regressor(Parameters());
    regressor.Enter(log);
    std::vector<MatrixXd> U;
    std::vector<double*> out;
    for (const int size : RowSizes(regressor, 0)) {
      U.emplace_back(1024, size);
      out.push_back(U.back().data());
    }
    for (long first = 0; first < samples; first += 1024) {
      const long count = std::min(1024L, samples - first);
      regressor.Differential(static_cast<int>(first), static_cast<int>(count),
                             out.data(), 1024);
      for (int i = 0; i < n; ++i) {
        const auto rows = Eigen::seqN(i * samples + first, count);
        A(rows, regressor.row_columns()[i]) = U[i].topRows(count);
        A(rows, m) = log.tau.col(i).segment(first, count);
      }
    }
    const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(A);
    benchmark::DoNotOptimize(A.data());
  }
  state.SetItemsProcessed(state.iterations() * samples);
}

// The kernel alone: chunks of a joint's rows, items are flops.
void Householder(benchmark::State& state, const simd::Kernels* kernels,
                 int columns) {
  const MatrixXd fresh = MatrixXd::Random(LeafFactor::kStride, columns);
  MatrixXd chunk, R = MatrixXd::Zero(columns, columns);
  for (auto _ : state) {
    chunk = fresh;
    kernels->householder(R.data(), columns, columns, chunk.data(),
                         LeafFactor::kStride, LeafFactor::kChunkRows, false);
  }
  state.SetItemsProcessed(state.iterations() * 2 * LeafFactor::kChunkRows *
                          columns * columns);
}

template <class... Arguments>
void Register(const std::string& name, Arguments... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), arguments...)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime();
}

const bool registered = [] {
  const auto differential = Identification::kDifferential;
  for (const long samples : {200000L, 1000000L}) {
    Register("LinearCalibration/" + std::to_string(samples), Calibrate,
             differential, samples, 1);
  }
  Register("DenseQr/200000", DenseQr, 200000L);
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    for (const int columns : {13, 49, 85}) {
      Register(std::string("Householder/") + kernels->instruction_set + "/" +
                   std::to_string(columns),
               Householder, kernels, columns);
    }
  }
  for (const int threads : {1, 2}) {
    benchmark::RegisterBenchmark(
        ("LinearCalibration/threads:" + std::to_string(threads)).c_str(),
        Calibrate, differential, 200000L, threads)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  Register("LinearCalibration/weak", Calibrate, Identification::kWeak, 200000L,
           1);
  Register("LinearCalibration/differential", Calibrate, differential, 200000L,
           1);
  return true;
}();

}  // namespace
}  // namespace armcal
