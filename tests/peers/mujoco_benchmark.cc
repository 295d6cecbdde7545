// MuJoCo on the benchmarks' arm, without contacts and limits, called from C.
// Counter `error`: largest difference to our recursive Newton-Euler, relative
// to the largest torque.

#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "model/urdf_writer.h"
#include "tests/benchmark_log.h"

namespace armcal {
namespace {

constexpr int kStates = 256;
constexpr int kSteps = 500;  // of a rollout, 1 ms each

struct MujocoArm {
  MujocoArm();
  void SetState(long row, double* acceleration);

  std::unique_ptr<mjModel, void (*)(mjModel*)> model{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data{nullptr, mj_deleteData};
  Log log;
};

MujocoArm::MujocoArm() {
  const Robot robot = BenchmarkRobot();
  const auto path =
      std::filesystem::temp_directory_path() / "armcal_mujoco_benchmark.urdf";
  std::ofstream(path) << MakeUrdf(robot);
  char error[1000] = "";
  model.reset(mj_loadXML(path.c_str(), nullptr, error, sizeof error));
  std::filesystem::remove(path);
  if (model == nullptr) throw std::runtime_error(error);
  mju_copy3(model->opt.gravity, robot.gravity.data());
  model->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_CONSTRAINT;
  model->opt.timestep = 1e-3;
  mju_zero(model->dof_damping, model->nv);
  data.reset(mj_makeData(model.get()));
  log = BenchmarkLog(robot, kStates * 50);
}

void MujocoArm::SetState(long row, double* acceleration) {
  for (int j = 0; j < model->nv; ++j) {
    data->qpos[j] = log.q(row, j);
    data->qvel[j] = log.qd(row, j);
    if (acceleration != nullptr) acceleration[j] = log.qdd(row, j);
  }
}

MujocoArm& Arm() {
  static MujocoArm arm;
  return arm;
}

void Inverse(benchmark::State& state) {
  MujocoArm& arm = Arm();
  for (auto _ : state) {
    for (int k = 0; k < kStates; ++k) {
      arm.SetState(50 * k, arm.data->qacc);
      mj_inverse(arm.model.get(), arm.data.get());
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kStates);
  double error = 0;
  for (int k = 0; k < kStates; ++k) {
    arm.SetState(50 * k, arm.data->qacc);
    mj_inverse(arm.model.get(), arm.data.get());
    for (int j = 0; j < arm.model->nv; ++j) {
      error = std::max(
          error, std::abs(arm.data->qfrc_inverse[j] - arm.log.tau(50 * k, j)));
    }
  }
  state.counters["error"] = error / arm.log.tau.lpNorm<Eigen::Infinity>();
}
BENCHMARK(Inverse)->Name("Mujoco/mj_inverse");

// The arm falls freely from a state of its motion.
void Step(benchmark::State& state, mjtIntegrator integrator) {
  MujocoArm& arm = Arm();
  arm.model->opt.integrator = integrator;
  for (auto _ : state) {
    mj_resetData(arm.model.get(), arm.data.get());
    arm.SetState(0, nullptr);
    for (int k = 0; k < kSteps; ++k) mj_step(arm.model.get(), arm.data.get());
  }
  state.SetItemsProcessed(state.iterations() * kSteps);
  if (!std::isfinite(arm.data->qpos[0])) state.SkipWithError("not finite");
}
BENCHMARK_CAPTURE(Step, rk4, mjINT_RK4)->Name("Mujoco/mj_step_rk4");
BENCHMARK_CAPTURE(Step, euler, mjINT_EULER)->Name("Mujoco/mj_step_euler");

const bool version_is_said = [] {
  benchmark::AddCustomContext("mujoco", mj_versionString());
  return true;
}();

}  // namespace
}  // namespace armcal
