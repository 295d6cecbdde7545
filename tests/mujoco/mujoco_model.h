#pragma once

// A robot in MuJoCo: a referee that shares no code.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "model/robot_files/urdf_writer.h"
#include "tests/fixtures/temp_file.h"

namespace armcal {

using MujocoModel = std::unique_ptr<mjModel, void (*)(mjModel*)>;
using MujocoData = std::unique_ptr<mjData, void (*)(mjData*)>;

// Null, and a failure of the test, where MuJoCo refuses the text.
inline MujocoModel LoadTextInMujoco(const std::string& xml,
                                    const std::string& name) {
  const std::string path = WriteFile(xml, name);
  char error[1000] = "";
  MujocoModel model(mj_loadXML(path.c_str(), nullptr, error, sizeof(error)),
                    mj_deleteModel);
  EXPECT_NE(model, nullptr) << error << "\n" << xml;
  return model;
}

// The URDF that MakeUrdf writes. Gravity, which it cannot say, is the robot's.
inline MujocoModel LoadInMujoco(const Robot& robot) {
  MujocoModel model = LoadTextInMujoco(MakeUrdf(robot), "mujoco.urdf");
  if (model == nullptr) return model;
  EXPECT_EQ(model->nv, robot.num_joints());
  mju_copy3(model->opt.gravity, robot.gravity.data());
  return model;
}

// Where MuJoCo keeps the joints, in the robot's order: in qpos, in qvel.
struct MujocoJoints {
  std::vector<int> q, v;

  MujocoJoints(const Robot& robot, const mjModel& model) {
    for (const Link& link : robot.links) {
      const int id = mj_name2id(&model, mjOBJ_JOINT, link.joint.name.c_str());
      EXPECT_GE(id, 0) << link.joint.name;
      if (id < 0) return;
      q.push_back(model.jnt_qposadr[id]);
      v.push_back(model.jnt_dofadr[id]);
    }
  }

  void SetMotion(const Eigen::VectorXd& position,
                 const Eigen::VectorXd& velocity,
                 const Eigen::VectorXd& acceleration, mjData* data) const {
    for (size_t j = 0; j < v.size(); ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      data->qpos[q[j]] = position[k];
      data->qvel[v[j]] = velocity[k];
      data->qacc[v[j]] = acceleration[k];
    }
  }

  // A vector over MuJoCo's degrees of freedom, in the robot's order.
  Eigen::VectorXd Read(const mjtNum* of_dofs) const {
    Eigen::VectorXd x(v.size());
    for (size_t j = 0; j < v.size(); ++j) {
      x[static_cast<Eigen::Index>(j)] = of_dofs[v[j]];
    }
    return x;
  }

  // Per joint, of the last mj_inverse or mj_forward: whether dry friction is
  // saturated. A joint without has no constraint, and nothing to saturate.
  std::vector<bool> Saturated(const mjData& data) const {
    std::vector<bool> saturated(v.size(), true);
    for (int i = 0; i < data.nefc; ++i) {
      if (data.efc_type[i] != mjCNSTR_FRICTION_DOF) continue;
      const auto joint = std::find(v.begin(), v.end(), data.efc_id[i]);
      saturated[joint - v.begin()] =
          data.efc_state[i] != mjCNSTRSTATE_QUADRATIC;
    }
    return saturated;
  }
};

}  // namespace armcal
