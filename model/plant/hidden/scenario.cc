#include "model/plant/hidden/scenario.h"

#include <memory>

#include "model/dynamics/rigid_arm.h"
#include "model/plant/hidden/joint_friction.h"
#include "model/plant/robot_variation.h"
#include "model/plant/simbody_arm.h"
#include "model/text/input_error.h"

namespace armcal {

namespace {

void CheckFits(const ChosenEffect& effect, const SimulatedRobot& robot,
               const EffectContext& context) {
  const std::string why = WhyNotApplicable(*effect.kind, robot, effect.joint,
                                           effect.parameters, context);
  if (why.empty()) return;
  throw InputError(
      robot.robot.name,
      "effect " + effect.kind->name +
          (effect.joint < 0 ? ""
                            : " on joint " + std::to_string(effect.joint + 1)),
      "", why);
}

}  // namespace

SimulatedRobot TrueRobot(const Scenario& scenario) {
  SimulatedRobot robot;
  robot.robot = VaryRobot(scenario.model, scenario.robot_error, scenario.seed);
  // The arm's own; effects that put joints under the base know how to move it.
  AddJointFriction(scenario.zero_velocity, &robot);
  if (scenario.misfit) scenario.misfit(&robot);
  return robot;
}

EffectContext ContextOf(const Scenario& scenario) {
  EffectContext context = TypicalContext(scenario.model, scenario.seed);
  context.run = scenario.run;
  context.time_scale = scenario.effect_time;
  context.duration = scenario.motion.duration;
  context.zero_velocity = scenario.zero_velocity;
  return context;
}

ScenarioRun RunScenario(const Scenario& scenario, ScenarioEngine engine) {
  SimulatedRobot robot = TrueRobot(scenario);
  const EffectContext context = ContextOf(scenario);
  ScenarioRun result;
  result.robot = robot.robot;
  result.effects.resize(scenario.effects.size());
  for (const bool changes_robot : {true, false}) {
    for (size_t k = 0; k < scenario.effects.size(); ++k) {
      const ChosenEffect& effect = scenario.effects[k];
      if (effect.kind->changes_robot != changes_robot) continue;
      CheckFits(effect, robot, context);
      result.effects[k] = {effect.kind->name, effect.joint,
                           effect.kind->in_catalogue,
                           ApplyHiddenEffect(*effect.kind, &robot, effect.joint,
                                             effect.parameters, context)};
    }
  }
  std::unique_ptr<ArmDynamics> dynamics;
  if (engine == ScenarioEngine::kSimbody) {
    dynamics = std::make_unique<SimbodyArm>(robot.robot);
  } else {
    dynamics = std::make_unique<RigidArm>(robot.robot);
  }
  result.run = RunClosedLoop(robot, scenario.model, scenario.motion,
                             scenario.loop, dynamics.get());
  return result;
}

}  // namespace armcal
