// MuJoCo on the benchmarks' arm, without contacts and limits, called from C.
// Counter `error`: largest difference to our recursive Newton-Euler, relative
// to the largest torque; of steps to the exact end of the fall, rad.

#include <benchmark/benchmark.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "model/robot_files/urdf_writer.h"
#include "tests/fixtures/benchmark_log.h"
#include "tests/fixtures/free_fall.h"

namespace armcal {
namespace {

constexpr int kStates = 256;
constexpr double kViscous = .2;  // N m s/rad, as Rollout/lanes_damped has it

struct MujocoArm {
  MujocoArm();
  void SetState(long row);

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
  mju_zero(model->dof_damping, model->nv);
  data.reset(mj_makeData(model.get()));
  log = BenchmarkLog(robot, kStates * 50);
}

void MujocoArm::SetState(long row) {
  for (int j = 0; j < model->nv; ++j) {
    data->qpos[j] = log.q(row, j);
    data->qvel[j] = log.qd(row, j);
    data->qacc[j] = log.qdd(row, j);
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
      arm.SetState(50 * k);
      mj_inverse(arm.model.get(), arm.data.get());
    }
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kStates);
  double error = 0;
  for (int k = 0; k < kStates; ++k) {
    arm.SetState(50 * k);
    mj_inverse(arm.model.get(), arm.data.get());
    for (int j = 0; j < arm.model->nv; ++j) {
      error = std::max(
          error, std::abs(arm.data->qfrc_inverse[j] - arm.log.tau(50 * k, j)));
    }
  }
  state.counters["error"] = error / arm.log.tau.lpNorm<Eigen::Infinity>();
}
BENCHMARK(Inverse)->Name("Mujoco/mj_inverse");

// The arm falls freely, with viscous friction or without.
void Step(benchmark::State& state, mjtIntegrator integrator, double viscous) {
  MujocoArm& arm = Arm();
  const FreeFall fall(viscous);
  arm.model->opt.integrator = integrator;
  arm.model->opt.timestep = FreeFall::kStep;
  mju_fill(arm.model->dof_damping, viscous, arm.model->nv);
  for (auto _ : state) {
    mj_resetData(arm.model.get(), arm.data.get());
    mju_copy(arm.data->qpos, fall.q.data(), arm.model->nv);
    mju_copy(arm.data->qvel, fall.qd.data(), arm.model->nv);
    for (int k = 0; k < FreeFall::kSteps; ++k) {
      mj_step(arm.model.get(), arm.data.get());
    }
  }
  state.SetItemsProcessed(state.iterations() * FreeFall::kSteps);
  const Eigen::Map<const Eigen::VectorXd> end(arm.data->qpos, arm.model->nv);
  if (!end.allFinite()) state.SkipWithError("not finite");
  state.counters["error"] = fall.Error(end);
  mju_zero(arm.model->dof_damping, arm.model->nv);
}
BENCHMARK_CAPTURE(Step, rk4, mjINT_RK4, 0)->Name("Mujoco/mj_step_rk4");
BENCHMARK_CAPTURE(Step, damped, mjINT_RK4, kViscous)
    ->Name("Mujoco/mj_step_rk4_damped");
BENCHMARK_CAPTURE(Step, euler, mjINT_EULER, 0)->Name("Mujoco/mj_step_euler");

const bool version_is_said = [] {
  benchmark::AddCustomContext("mujoco", mj_versionString());
  return true;
}();

}  // namespace
}  // namespace armcal
