// Damping and frictionloss of robot files in MuJoCo. Its dry friction is a soft
// constraint: it wants the acceleration -b qd, so that a joint stops within
// 1/b, and gives the force for it as long as that stays below frictionloss
// (state "quadratic"). Where it would take more, the force is frictionloss
// exactly (state "linear"): there, and only there, it is Coulomb's.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/nonlinear_runs.h"
#include "tests/mujoco/calibrated_robot.h"
#include "tests/mujoco/mujoco_model.h"

namespace armcal::friction_test {

using Eigen::VectorXd;

// b = 2 / (dmax timeconst) of MuJoCo's default solref and solimp, 105 1/s: it
// brakes qd + qdd / b, which has the sign of qd above this velocity at our
// accelerations.
constexpr double kMostAcceleration = 5;  // rad/s^2 or m/s^2
constexpr double kSlowest = kMostAcceleration * (.95 * .02) / 2;

constexpr int kStates = 200;

// MakeUrdf writes ten digits; nothing else is lost where friction is saturated.
constexpr double kDigits = 1e-9;

// What the file's robot has, N m or N.
VectorXd Friction(const Robot& robot, const VectorXd& qd) {
  VectorXd tau(qd.size());
  for (Eigen::Index j = 0; j < qd.size(); ++j) {
    const Joint& joint = robot.links[j].joint;
    tau[j] = joint.viscous * qd[j] + joint.coulomb * (qd[j] > 0 ? 1 : -1);
  }
  return tau;
}

class MujocoFriction : public testing::Test {
 protected:
  void Load(const Robot& robot);
  void SetArmature();  // that URDF has no field for

  // Friction in the direction of a motor's torque, N m or N.
  VectorXd MujocoTorque() const {
    return -joints_->Read(data_->qfrc_constraint) -
           joints_->Read(data_->qfrc_passive);
  }

  // Whether all joints move and are saturated.
  bool ExpectSameFriction(const VectorXd& qd);
  void ExpectSameAcceleration(const VectorXd& tau, const VectorXd& qd,
                              const VectorXd& qdd);
  void Count(const VectorXd& qd);
  void Run();
  void ExpectMostSaturated() const;
  void PrintCounts() const;

  Robot robot_;
  MujocoModel model_{nullptr, mj_deleteModel};
  MujocoData data_{nullptr, mj_deleteData};
  std::optional<MujocoJoints> joints_;
  std::vector<int> moving_, saturated_;  // states, per joint
  int all_saturated_ = 0;
};

void MujocoFriction::Load(const Robot& robot) {
  robot_ = robot;
  model_ = LoadInMujoco(robot);
  ASSERT_NE(model_, nullptr);
  model_->opt.disableflags |= mjDSBL_LIMIT;
  joints_.emplace(robot, *model_);
  ASSERT_EQ(joints_->v.size(), robot.num_joints());
  data_ = MujocoData(mj_makeData(model_.get()), mj_deleteData);
}

void MujocoFriction::SetArmature() {
  for (int j = 0; j < robot_.num_joints(); ++j) {
    model_->dof_armature[joints_->v[j]] = robot_.links[j].joint.armature;
  }
  mj_setConst(model_.get(), data_.get());
}

bool MujocoFriction::ExpectSameFriction(const VectorXd& qd) {
  const VectorXd theirs = MujocoTorque();
  const VectorXd ours = Friction(robot_, qd);
  const std::vector<bool> saturated = joints_->Saturated(*data_);
  bool all = true;
  for (int j = 0; j < robot_.num_joints(); ++j) {
    const bool moves = std::abs(qd[j]) > kSlowest;
    all = all && moves && saturated[j];
    if (!moves) continue;
    if (saturated[j]) {
      EXPECT_NEAR(theirs[j], ours[j], kDigits * std::abs(ours[j]))
          << robot_.links[j].joint.name << " at " << qd[j];
    } else {  // creeping: less than Coulomb's
      const double dry = theirs[j] - robot_.links[j].joint.viscous * qd[j];
      EXPECT_LE(std::abs(dry), robot_.links[j].joint.coulomb * (1 + kDigits));
    }
  }
  return all;
}

// Forward: the torque that we say it takes moves MuJoCo's arm as asked for.
// The difference as a torque, as a light wrist turns rounding into rad/s^2.
void MujocoFriction::ExpectSameAcceleration(const VectorXd& tau,
                                            const VectorXd& qd,
                                            const VectorXd& qdd) {
  VectorXd difference(qdd.size()), torque(qdd.size());
  for (size_t j = 0; j < joints_->v.size(); ++j) {
    data_->qfrc_applied[joints_->v[j]] = tau[static_cast<Eigen::Index>(j)];
  }
  mj_forward(model_.get(), data_.get());
  EXPECT_TRUE(ExpectSameFriction(qd));
  for (size_t j = 0; j < joints_->v.size(); ++j) {
    difference[joints_->v[j]] = data_->qacc[joints_->v[j]] - qdd[j];
  }
  mj_mulM(model_.get(), data_.get(), torque.data(), difference.data());
  EXPECT_LE(torque.norm(), 1e-6 * tau.norm());
}

// Else there is nothing to compare.
void MujocoFriction::ExpectMostSaturated() const {
  for (int j = 0; j < robot_.num_joints(); ++j) {
    EXPECT_GT(saturated_[j], moving_[j] / 2) << robot_.links[j].joint.name;
  }
}

void MujocoFriction::Count(const VectorXd& qd) {
  const std::vector<bool> saturated = joints_->Saturated(*data_);
  for (int j = 0; j < robot_.num_joints(); ++j) {
    if (std::abs(qd[j]) <= kSlowest) continue;
    ++moving_[j];
    saturated_[j] += saturated[j];
  }
}

// And the velocity below which MuJoCo's joint creeps, by its documentation:
// frictionloss times R / b, R = (1 - d) / d of the joint's inverse inertia.
void MujocoFriction::PrintCounts() const {
  std::printf("%-10s all joints saturated in %d of %d states\n",
              robot_.name.c_str(), all_saturated_, kStates);
  for (int j = 0; j < robot_.num_joints(); ++j) {
    const int v = joints_->v[j];
    std::printf("  %-20s armature %.3g  saturated %d of %d  below %.2g %s/s\n",
                robot_.links[j].joint.name.c_str(), model_->dof_armature[v],
                saturated_[j], moving_[j],
                model_->dof_frictionloss[v] * (.1 / .9) *
                    model_->dof_invweight0[v] * (.95 * .02) / 2,
                PositionUnit(robot_.links[j].joint.type));
  }
}

void MujocoFriction::Run() {
  const int n = robot_.num_joints();
  moving_.assign(n, 0);
  saturated_.assign(n, 0);
  all_saturated_ = 0;
  std::mt19937_64 random(5);
  for (int k = 0; k < kStates; ++k) {
    const VectorXd q = UniformVector(&random, n, -3, 3);
    const VectorXd qd = UniformVector(&random, n, -2, 2);
    const VectorXd qdd =
        UniformVector(&random, n, -kMostAcceleration, kMostAcceleration);
    joints_->SetMotion(q, qd, qdd, data_.get());
    mj_inverse(model_.get(), data_.get());
    const bool all = ExpectSameFriction(qd);
    Count(qd);
    if (!all) continue;
    ++all_saturated_;
    VectorXd ours = InverseDynamics(robot_, q, qd, qdd) + Friction(robot_, qd);
    for (int j = 0; j < n; ++j) {
      ours[j] += model_->dof_armature[joints_->v[j]] * qdd[j];
    }
    const VectorXd theirs = joints_->Read(data_->qfrc_inverse);
    EXPECT_LE((theirs - ours).norm(), 1e-6 * ours.norm());
    ExpectSameAcceleration(ours, qd, qdd);
  }
  PrintCounts();
}

TEST_F(MujocoFriction, SimulatedArms) {
  for (const char* name : {"UR5 6R", "Panda 7R", "SCARA RRPR"}) {
    std::mt19937_64 random(4);
    Load(MakeArm(name, .3, &random).truth);
    Run();
    ExpectMostSaturated();
    SetArmature();
    Run();
    ExpectMostSaturated();
  }
}

TEST_F(MujocoFriction, CalibratedUr10e) {
  if (!std::filesystem::exists(SHARED_DIR "/data/ur10e_free")) {
    GTEST_SKIP() << "shared/data/ur10e_free is not here";
  }
  Load(CalibratedUr10e());
  // The file alone has no armature: the wrist is so light that MuJoCo's dry
  // friction creeps where it should slide (wrist_3 below 15 rad/s).
  Run();
  SetArmature();
  Run();
  ExpectMostSaturated();
}

}  // namespace armcal::friction_test
