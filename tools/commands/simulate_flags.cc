#include "tools/commands/simulate_flags.h"

#include <gflags/gflags.h>

#include "model/plant/motion_reader.h"
#include "model/robot_files/controller_reader.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "tools/command.h"
#include "tools/commands/simulate_effects.h"
#include "tools/input_flags.h"
#include "tools/simulation_flags.h"

DEFINE_string(effects, "",
              "`EFFECTS` hidden, NAME[@JOINT][:PARAMETER=VALUE,..] with a "
              "semicolon between them; --list_effects shows all");
DEFINE_double(robot_error, 0,
              "relative standard deviation by which the real robot's masses, "
              "inertias and friction differ from the robot file");
DEFINE_double(friction_width, 0.005,
              "speed within which friction changes sign, rad/s");
DEFINE_string(
    motion, "fourier",
    "`FILE` or what to follow: fourier, points (rests between moves), or a CSV "
    "with t,q1..[,qd1..,qdd1..]");
DEFINE_double(duration, 20, "`S` of a motion that is not from a file");
DEFINE_double(size, 0.8, "share of the joints' range that they use");
DEFINE_double(speed, 1, "share of the joints' speed that they use");
DEFINE_string(joints, "", "`1,2..` that they move; default: all");
DEFINE_double(standstill, 1, "`S` before and after the motion");
DEFINE_string(encoder_resolution, "5e-6",
              "rad or m, one number or one per joint; 0: exact");
DEFINE_string(encoder_noise, "3e-6", "standard deviation, the same way");
DEFINE_string(torque_noise, "0.01",
              "white, share of each joint's usual torque, one number or one "
              "per joint");
DEFINE_string(coloured_noise, "0.005", "correlated, the same way");
DEFINE_double(noise_correlation, 0.05, "of the correlated noise, s");
DEFINE_double(torque_delay, 0, "of the log's torques behind positions, s");
DEFINE_double(log_rate, 250,
              "`HZ` of the log; simulated: has to divide the controller's");
DEFINE_double(jitter, 0, "of the sampling instants, standard deviation, s");
DEFINE_double(lost, 0, "share of samples that are lost");
DEFINE_uint64(run, 0,
              "which log of the robot that --seed draws: its motion, noise and "
              "what comes and goes are drawn anew");
DEFINE_double(step, 1e-3, "of the integration, s");

namespace armcal {

namespace {

constexpr double kLongest = 1e4;  // s, of a motion or a rest

double Within(const FlagValues& flags, const char* flag, double low,
              double high) {
  const double value = flags.Number(flag);
  if (value >= low && value <= high) return value;
  throw UsageError("--" + std::string(flag) + ": found '" + NumberText(value) +
                   "', expected a number from " + NumberText(low) + " to " +
                   NumberText(high));
}

std::vector<int> MovingJoints(const FlagValues& flags, int n) {
  std::vector<int> joints;
  for (const double number : ParseNumbers("joints", flags.Text("joints"))) {
    const int joint = static_cast<int>(number);
    if (joint != number || joint < 1 || joint > n) {
      throw UsageError("--joints: found '" + flags.Text("joints") +
                       "', expected numbers from 1 to " + std::to_string(n));
    }
    joints.push_back(joint - 1);
  }
  return joints;
}

ReferenceMotion MotionFromFlags(const FlagValues& flags, const Robot& robot,
                                double speed) {
  MotionOptions options;
  options.duration = Within(flags, "duration", .1, kLongest);
  options.size = Within(flags, "size", 0, 1);
  options.speed = speed * Within(flags, "speed", 0, 1);
  options.joints = MovingJoints(flags, robot.num_joints());
  options.seed = SeedFromFlags(flags);
  options.run = flags.Natural("run");
  const double rest = Within(flags, "standstill", 0, kLongest);
  if (flags.Text("motion") == "fourier") {
    return WithStandstill(FourierMotion(robot, options), rest, rest);
  }
  if (flags.Text("motion") == "points") {
    return WithStandstill(PointToPointMotion(robot, options), rest, rest);
  }
  const ReferenceMotion motion =
      ReadReferenceMotion(flags.Text("motion"), robot);
  if (motion.duration > kLongest) {
    throw InputError(flags.Text("motion"), "",
                     NumberText(motion.duration) + " s",
                     "expected a motion of at most " + NumberText(kLongest) +
                         " s; is its time in ms?");
  }
  return WithStandstill(motion, rest, rest);
}

SensorOptions SensorsFromFlags(const FlagValues& flags, const Robot& robot) {
  const int n = robot.num_joints();
  const Eigen::VectorXd usual =
      TypicalContext(robot, SeedFromFlags(flags)).torque;
  SensorOptions options;
  options.encoder_resolution =
      ParsePerJoint("encoder_resolution", flags.Text("encoder_resolution"), n);
  options.encoder_noise =
      ParsePerJoint("encoder_noise", flags.Text("encoder_noise"), n);
  options.torque_noise =
      ParsePerJoint("torque_noise", flags.Text("torque_noise"), n)
          .cwiseProduct(usual);
  options.coloured_noise =
      ParsePerJoint("coloured_noise", flags.Text("coloured_noise"), n)
          .cwiseProduct(usual);
  options.noise_correlation = Within(flags, "noise_correlation", 1e-4, 1e4);
  options.torque_delay = Within(flags, "torque_delay", 0, 1);
  options.log_rate_hz = Within(flags, "log_rate", 1, kFastestHz);
  options.jitter = Within(flags, "jitter", 0, 1);
  options.lost_share = Within(flags, "lost", 0, .5);
  options.seed = SeedFromFlags(flags);
  options.run = flags.Natural("run");
  return options;
}

void RequireMasses(const CommandInput& input, const Robot& robot) {
  for (const Link& link : robot.links) {
    if (link.has_inertial || IsDeclaredMassless(link)) continue;
    throw InputError(RobotFileFromFlags(input).name(), "link " + link.name, "",
                     "it has no mass; expected a robot file whose links have "
                     "inertias, to simulate");
  }
}

}  // namespace

Scenario ScenarioFromFlags(const CommandInput& input, const UsualLoop& loop) {
  const FlagValues& flags = input.flags;
  Scenario scenario;
  scenario.model = RobotFromFlags(input);
  RequireMasses(input, scenario.model);
  scenario.robot_error = Within(flags, "robot_error", 0, .5);
  scenario.zero_velocity = Within(flags, "friction_width", 1e-4, 1);
  scenario.motion = MotionFromFlags(flags, scenario.model, loop.speed);
  scenario.loop.controller = ControllerFromFlags(
      flags, scenario.model, scenario.motion, loop.bandwidth_hz);
  scenario.loop.sensors = SensorsFromFlags(flags, scenario.model);
  scenario.loop.step = Within(flags, "step", 1e-5, .01);
  scenario.seed = SeedFromFlags(flags);
  scenario.run = flags.Natural("run");
  scenario.effects = ParseEffects(flags.Text("effects"), scenario);
  return scenario;
}

}  // namespace armcal
