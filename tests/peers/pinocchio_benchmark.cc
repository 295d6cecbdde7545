// Pinocchio on the benchmarks' arm and motion: the library of PyPI's wheel,
// with its own instantiations of the algorithms, called from C++. Counter
// `error`: largest difference to our recursive Newton-Euler, relative to the
// largest torque.

#include <benchmark/benchmark.h>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <vector>

#include "model/robot/robot.h"
#include "tests/fixtures/benchmark_log.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr int kStates = 256;

// Frames with z along the joints' axes, for which Pinocchio is fastest.
pinocchio::Model MakeModel(const Robot& robot) {
  pinocchio::Model model;
  model.gravity.linear(robot.gravity);
  pinocchio::JointIndex parent = 0;
  Eigen::Isometry3d X_ML = Eigen::Isometry3d::Identity();  // of the parent
  for (const Link& link : robot.links) {
    const Eigen::Isometry3d X_MF = X_ML * link.X_PF;
    parent = model.addJoint(parent, pinocchio::JointModelRZ(),
                            pinocchio::SE3(X_MF.rotation(), X_MF.translation()),
                            link.joint.name);
    X_ML = link.X_ML;
    model.appendBodyToJoint(parent,
                            pinocchio::Inertia::FromDynamicParameters(
                                link.inertial.ReexpressIn(X_ML).ToVector()),
                            pinocchio::SE3::Identity());
  }
  return model;
}

// The arm at states of its motion.
struct PinocchioArm {
  PinocchioArm() : model(MakeModel(BenchmarkRobot())), data(model) {
    const Log log = BenchmarkLog(BenchmarkRobot(), kStates * 50);
    for (int k = 0; k < kStates; ++k) {
      q.push_back(log.q.row(50 * k));
      qd.push_back(log.qd.row(50 * k));
      qdd.push_back(log.qdd.row(50 * k));
      // The links' alone: friction and armature are no part of it here.
      tau.push_back(log.tau.row(50 * k).transpose());
    }
    for (size_t i = 0; i < model.inertias.size() - 1; ++i) {
      parameters.conservativeResize(parameters.size() + 10);
      parameters.tail<10>() = model.inertias[i + 1].toDynamicParameters();
    }
  }

  pinocchio::Model model;
  pinocchio::Data data;
  std::vector<VectorXd> q, qd, qdd, tau;
  VectorXd parameters;
};

PinocchioArm& Arm() {
  static PinocchioArm arm;
  return arm;
}

// Times evaluate(k) at all states, then what torque_error(k) says of them.
template <class Evaluate, class Error>
void Run(benchmark::State& state, const Evaluate& evaluate,
         const Error& torque_error) {
  PinocchioArm& arm = Arm();
  for (auto _ : state) {
    for (int k = 0; k < kStates; ++k) evaluate(&arm, k);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kStates);
  double error = 0, largest = 0;
  for (int k = 0; k < kStates; ++k) {
    evaluate(&arm, k);
    error = std::max(error, torque_error(arm, k));
    largest = std::max(largest, arm.tau[k].lpNorm<Eigen::Infinity>());
  }
  state.counters["error"] = error / largest;
}

void Regressor(benchmark::State& state) {
  Run(
      state,
      [](PinocchioArm* a, int k) {
        pinocchio::computeJointTorqueRegressor(a->model, a->data, a->q[k],
                                               a->qd[k], a->qdd[k]);
      },
      [](const PinocchioArm& a, int k) {
        return (a.data.jointTorqueRegressor * a.parameters - a.tau[k])
            .lpNorm<Eigen::Infinity>();
      });
}
BENCHMARK(Regressor)->Name("Pinocchio/computeJointTorqueRegressor");

void Rnea(benchmark::State& state) {
  Run(
      state,
      [](PinocchioArm* a, int k) {
        pinocchio::rnea(a->model, a->data, a->q[k], a->qd[k], a->qdd[k]);
      },
      [](const PinocchioArm& a, int k) {
        return (a.data.tau - a.tau[k]).lpNorm<Eigen::Infinity>();
      });
}
BENCHMARK(Rnea)->Name("Pinocchio/rnea");

// Of forward dynamics, what is left of the torque at the acceleration found.
void Aba(benchmark::State& state) {
  Run(
      state,
      [](PinocchioArm* a, int k) {
        pinocchio::aba(a->model, a->data, a->q[k], a->qd[k], a->tau[k]);
      },
      [](const PinocchioArm& a, int k) {
        pinocchio::Data data(a.model);
        return (pinocchio::rnea(a.model, data, a.q[k], a.qd[k], a.data.ddq) -
                a.tau[k])
            .lpNorm<Eigen::Infinity>();
      });
}
BENCHMARK(Aba)->Name("Pinocchio/aba");

void Crba(benchmark::State& state) {
  Run(
      state,
      [](PinocchioArm* a, int k) {
        pinocchio::crba(a->model, a->data, a->q[k]);
      },
      [](const PinocchioArm& a, int k) {
        pinocchio::Data data(a.model);
        const VectorXd bias = pinocchio::rnea(a.model, data, a.q[k], a.qd[k],
                                              VectorXd::Zero(a.model.nv));
        return (a.data.M.selfadjointView<Eigen::Upper>() * a.qdd[k] + bias -
                a.tau[k])
            .lpNorm<Eigen::Infinity>();
      });
}
BENCHMARK(Crba)->Name("Pinocchio/crba");

void RneaDerivatives(benchmark::State& state) {
  Run(
      state,
      [](PinocchioArm* a, int k) {
        pinocchio::computeRNEADerivatives(a->model, a->data, a->q[k], a->qd[k],
                                          a->qdd[k]);
      },
      [](const PinocchioArm& a, int k) {
        return (a.data.tau - a.tau[k]).lpNorm<Eigen::Infinity>();
      });
}
BENCHMARK(RneaDerivatives)->Name("Pinocchio/computeRNEADerivatives");

}  // namespace
}  // namespace armcal
