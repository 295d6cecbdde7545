#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/plant/closed_loop.h"
#include "model/plant/hidden/hidden_effects.h"
#include "model/plant/reference_motion.h"
#include "model/robot/robot.h"

namespace armcal {

struct ChosenEffect {
  const HiddenEffect* kind = nullptr;
  int joint = -1;              // from 0; -1: the whole robot
  Eigen::VectorXd parameters;  // in the order of kind->parameters
};

// A real robot that somebody else's model is to be calibrated on.
struct Scenario {
  Robot model;             // the robot file: what its controller knows
  double robot_error = 0;  // how far the true robot is from it, VaryRobot
  // Speed within which friction changes sign, rad/s (0.3 of it in m/s).
  double zero_velocity = .005;
  // The time in which effects that drift, warm up or age do so, s; not the
  // motion's, since logs of one robot may differ in length.
  double effect_time = 40;
  std::vector<ChosenEffect> effects;
  // Gives the true robot what no effect has; may be empty.
  std::function<void(SimulatedRobot* robot)> misfit;
  ReferenceMotion motion;
  ClosedLoopOptions loop;
  uint64_t seed = 0;  // of the robot's errors and of what effects draw
  uint64_t run = 0;   // of what effects draw anew for each log of that robot
};

// The robot without its effects, and what their sizes are relative to.
SimulatedRobot TrueRobot(const Scenario& scenario);
EffectContext ContextOf(const Scenario& scenario);

struct AppliedEffect {
  std::string name;
  int joint;
  bool in_catalogue;
  std::vector<EffectValue> values;
};

struct ScenarioRun {
  ClosedLoopRun run;
  Robot robot;  // the true one, without the effects
  std::vector<AppliedEffect> effects;
};

// The log of the scenario, by Simbody unless our own, faster dynamics are asked
// for. Throws InputError where an effect does not fit the robot or the robot
// cannot be simulated.
enum class ScenarioEngine { kSimbody, kRigidArm };
ScenarioRun RunScenario(const Scenario& scenario,
                        ScenarioEngine engine = ScenarioEngine::kSimbody);

}  // namespace armcal
