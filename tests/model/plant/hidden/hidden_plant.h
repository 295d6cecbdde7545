#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/plant/hidden/hidden_effects.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal {

// A UR5-like arm with one effect, whose scales are round numbers: 10 N m,
// 1 rad/s, 2 kg m^2 for every joint, a width of 5 mrad/s and a log of 40 s.
struct HiddenPlant {
  explicit HiddenPlant(const std::string& robot_name = "UR5 6R") {
    std::mt19937_64 random(1);
    robot.robot = SampleRobot(robot_name);
    SetRandomInertials(&random, &robot.robot);
    const int n = robot.robot.num_joints();
    context.torque = Eigen::VectorXd::Constant(n, 10);
    context.speed = Eigen::VectorXd::Ones(n);
    context.inertia = Eigen::VectorXd::Constant(n, 2);
    at.position = at.velocity = at.link_position = at.link_velocity = at.load =
        at.temperature = Eigen::VectorXd::Zero(n);
  }
  HiddenPlant(const std::string& effect, int joint,
              const std::vector<double>& parameters)
      : HiddenPlant() {
    Add(effect, joint, parameters);
  }

  void Add(const std::string& effect, int joint,
           const std::vector<double>& parameters) {
    const auto added = ApplyHiddenEffect(
        *FindHiddenEffect(effect), &robot, joint,
        Eigen::Map<const Eigen::VectorXd>(parameters.data(), parameters.size()),
        context);
    values.insert(values.end(), added.begin(), added.end());
  }

  // Of the effect added last that has it.
  double Value(const std::string& name) const {
    for (auto value = values.rbegin(); value != values.rend(); ++value) {
      if (value->name == name) return value->value;
    }
    ADD_FAILURE() << "no value " << name;
    return 0;
  }

  // Of the joint law `law` at the instant `at`.
  double Torque(int law = 0, const double* state = nullptr,
                double* rate = nullptr) const {
    return robot.joint_laws[law].torque(at, state, rate);
  }
  // Of joint 0 of a law that depends on the velocity.
  double TorqueAt(double velocity) {
    at.velocity[0] = velocity;
    return Torque();
  }
  double Transmitted(double deflection, double rate) const {
    return robot.transmissions[0].torque(deflection, rate, nullptr, nullptr);
  }
  // What the motors give for a command.
  Eigen::VectorXd Given(Eigen::VectorXd torque, const double* state = nullptr,
                        double* rate = nullptr) const {
    robot.actuators[0].apply(at, state, rate, &torque);
    return torque;
  }

  SimulatedRobot robot;
  EffectContext context;
  ArmInstant at;
  std::vector<EffectValue> values;
};

}  // namespace armcal
