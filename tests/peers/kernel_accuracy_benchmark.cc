// How exact our kernels are, by the measure of the other engines' counter
// `error`: largest difference to recursive Newton-Euler, relative to the
// largest torque. Their time is measured elsewhere.

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "model/dynamics/batch_inverse_dynamics.h"
#include "model/dynamics/batch_regressor.h"
#include "tests/fixtures/benchmark_log.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr long kSamples = 4096;

std::vector<double*> Columns(MatrixXd* x) {
  std::vector<double*> columns;
  for (Eigen::Index j = 0; j < x->cols(); ++j) {
    columns.push_back(x->col(j).data());
  }
  return columns;
}

// The links' columns times their parameters.
MatrixXd TorqueByRegressor(const Robot& robot, const simd::Kernels& kernels,
                           const MotionColumns& motion) {
  const int n = robot.num_joints();
  VectorXd parameters(10 * n);
  for (int i = 0; i < n; ++i) {
    parameters.segment<10>(10 * i) = robot.links[i].inertial.ToVector();
  }
  const BatchRegressor regressor(robot, kernels);
  std::vector<MatrixXd> rows;
  std::vector<double*> out;
  for (int i = 0; i < n; ++i) {
    rows.emplace_back(kSamples, regressor.row_size(i));
    out.push_back(rows.back().data());
  }
  regressor.Differential(motion, kSamples, out.data(), kSamples);
  MatrixXd tau(kSamples, n);
  for (int i = 0; i < n; ++i) {
    tau.col(i) = rows[i] * parameters.tail(rows[i].cols());
  }
  return tau;
}

void Error(benchmark::State& state, const simd::Kernels* kernels,
           bool by_regressor) {
  const Robot robot = BenchmarkRobot();
  const Log log = BenchmarkLog(robot, kSamples);
  const MotionColumns motion(log.q, log.qd, log.qdd, {});
  MatrixXd tau(kSamples, robot.num_joints());
  for (auto _ : state) {
    if (by_regressor) {
      tau = TorqueByRegressor(robot, *kernels, motion);
    } else {
      BatchInverseDynamics(robot, *kernels)
          .Torque(motion, kSamples, Columns(&tau).data());
    }
  }
  state.SetItemsProcessed(state.iterations() * kSamples);
  state.counters["error"] = (tau - log.tau).lpNorm<Eigen::Infinity>() /
                            log.tau.lpNorm<Eigen::Infinity>();
}

const bool registered = [] {
  for (const simd::Kernels* kernels : simd::AvailableKernels()) {
    for (const bool by_regressor : {true, false}) {
      const std::string name = by_regressor ? "LinkColumns" : "Torque";
      benchmark::RegisterBenchmark(
          ("Accuracy/" + name + "/" + kernels->instruction_set).c_str(), Error,
          kernels, by_regressor)
          ->Iterations(1);
    }
  }
  return true;
}();

}  // namespace
}  // namespace armcal
