// Linear calibration of logs in memory, beside Eigen's QR of the whole.

#include <benchmark/benchmark.h>
#include <glog/logging.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/QR>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "calib/linear/row_reduction.h"
#include "calib/numerics/thread_limit.h"
#include "calib/numerics/triangular_factor.h"
#include "model/simd/kernels.h"
#include "problems/make_rows.h"
#include "tests/benchmarks/in_memory_calibration.h"
#include "tests/fixtures/benchmark_log.h"
#include "tests/fixtures/sample_motion.h"

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

// Items are samples, in CPU time; in elapsed time where threads are compared.
void Calibrate(benchmark::State& state, Identification identification,
               long samples, int threads, bool elapsed) {
  const Trajectory& log = BenchmarkTrajectory(samples);
  const ThreadLimit limit(threads);
  const auto begin = std::chrono::steady_clock::now();
  for (auto _ : state) {
    const InMemoryCalibration calibration(Parameters(), Options(identification),
                                          log);
    benchmark::DoNotOptimize(calibration.covariance.data());
  }
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - begin;
  const double items = static_cast<double>(state.iterations() * samples);
  state.SetItemsProcessed(state.iterations() * samples);
  if (elapsed) state.counters["items_per_second"] = items / seconds.count();
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

// Rows alone, evaluated a leaf at a time; items are samples.
void Rows(benchmark::State& state, Identification identification) {
  const Trajectory& log = BenchmarkTrajectory(20000);
  const RowOptions options = Options(identification);
  MotionRegressor regressor(Parameters());
  regressor.Enter(log);
  const auto rows = MakeRows(log, options, regressor);
  const long most = std::min(RowsPerLeaf(options), LeafFactor::kChunkRows);
  JointColumns columns;
  columns.Resize(RowSizes(regressor, 1), most);
  RowScratch scratch;
  for (auto _ : state) {
    for (long begin = 0; begin < rows->size(); begin += most) {
      rows->Evaluate(begin, std::min(most, rows->size() - begin),
                     columns.data(), columns.stride(), &scratch);
    }
    benchmark::DoNotOptimize(columns.column(0, 0));
  }
  state.SetItemsProcessed(state.iterations() * log.size());
}

// What /proc says of this process's memory, MB: now or at its peak.
double StatusMegabytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) {
      return std::stod(line.substr(key.size() + 1)) / 1024;
    }
  }
  return std::nan("");
}

// Peak memory of a calibration beyond the log it is given, MB, in a process of
// its own; nan where the system does not say.
double MegabytesBeyond(long samples) {
  int ends[2];
  PCHECK(pipe(ends) == 0);
  const pid_t child = fork();
  PCHECK(child >= 0);
  double beyond = std::nan("");
  if (child == 0) {
    const Trajectory& log = BenchmarkTrajectory(samples);
    malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
    const double before = StatusMegabytes("VmRSS");
    const InMemoryCalibration calibration(
        Parameters(), Options(Identification::kDifferential), log);
    beyond = StatusMegabytes("VmHWM") - before;
    PCHECK(write(ends[1], &beyond, sizeof beyond) == sizeof beyond);
    _exit(0);
  }
  close(ends[1]);
  if (read(ends[0], &beyond, sizeof beyond) != sizeof beyond) {
    beyond = std::nan("");
  }
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return beyond;
}

void MemoryGrowth(benchmark::State& state) {
  double growth = 0;
  for (auto _ : state) {
    growth = MegabytesBeyond(1000000) - MegabytesBeyond(10000);
  }
  state.counters["value"] = growth;
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
      ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  const auto differential = Identification::kDifferential;
  for (const long samples : {200000L, 1000000L}) {
    Register("LinearCalibration/" + std::to_string(samples), Calibrate,
             differential, samples, 1, false);
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
    Register("LinearCalibration/threads:" + std::to_string(threads), Calibrate,
             differential, 1000000L, threads, true);
  }
  benchmark::RegisterBenchmark("Memory/growth_mb", MemoryGrowth)->Iterations(1);
  Register("WeakRows/chunk", Rows, Identification::kWeak);
  Register("DifferentialRows/chunk", Rows, differential);
  Register("LinearCalibration/weak", Calibrate, Identification::kWeak, 200000L,
           1, false);
  return true;
}();

}  // namespace
}  // namespace armcal
