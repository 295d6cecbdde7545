#include "calib/motion_options.h"

#include <algorithm>
#include <cmath>

#include "model/text/input_text.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

void CheckWithin(const std::string& option, double value, double low,
                 double high) {
  if (value >= low && value <= high) return;
  throw OptionError(OptionName(option) + ": found '" + NumberText(value) +
                    "', expected a number from " + NumberText(low) + " to " +
                    NumberText(high));
}

void SetPositive(const std::string& option, const Eigen::VectorXd& given,
                 Eigen::VectorXd* values) {
  if (given.size() == 0) return;
  *values = PerJoint(option, given, static_cast<int>(values->size()));
  if (values->minCoeff() > 0) return;
  throw OptionError(OptionName(option) + ": found '" +
                    NumberText(values->minCoeff()) +
                    "', expected numbers above 0");
}

// Sentences of the robot's own limits, but for those that are given.
void AddAssumed(const std::vector<std::string>& of_robot,
                const ExcitationLimits& given,
                std::vector<std::string>* assumed) {
  const std::pair<const char*, bool> words[] = {
      {"positions", given.lower.size() > 0},
      {"velocities", given.velocity.size() > 0},
      {"accelerations", given.acceleration.size() > 0},
      {"any torque", given.effort.size() > 0}};
  for (const std::string& sentence : of_robot) {
    const bool set =
        std::any_of(std::begin(words), std::end(words), [&](const auto& word) {
          return word.second && sentence.rfind(word.first, 0) == 0;
        });
    if (!set) assumed->push_back(sentence);
  }
}

MotionLimits LimitsFor(const Robot& robot, const ExcitationLimits& given,
                       std::vector<std::string>* assumed) {
  const int n = robot.num_joints();
  std::vector<std::string> of_robot;
  MotionLimits limits = LimitsOf(robot, &of_robot);
  if (given.lower.size() > 0 || given.upper.size() > 0) {
    limits.lower = PerJoint("position_limits", given.lower, n);
    limits.upper = PerJoint("position_limits", given.upper, n);
  }
  SetPositive("velocity_limits", given.velocity, &limits.velocity);
  if (given.velocity.size() > 0) limits.acceleration = 3 * limits.velocity;
  SetPositive("acceleration_limits", given.acceleration, &limits.acceleration);
  SetPositive("effort_limits", given.effort, &limits.effort);
  AddAssumed(of_robot, given, assumed);
  CheckWithin("use", given.use, .05, 1);
  return limits.Within(given.use);
}

Workspace WorkspaceFor(const Robot& robot, const ExciteOptions& options,
                       const MotionLimits& limits) {
  CheckWithin("link_radius", options.workspace.link_radius, .005, 1);
  return MakeFor(robot, options, "within the limits ", [&] {
    return Workspace(robot, options.workspace, limits.lower, limits.upper);
  });
}

}  // namespace

Eigen::VectorXd PerJoint(const std::string& option,
                         const Eigen::VectorXd& values, int n) {
  if (values.size() == 1) return Eigen::VectorXd::Constant(n, values[0]);
  if (values.size() == n) return values;
  throw OptionError(OptionName(option) + ": found " +
                    std::to_string(values.size()) +
                    " numbers, expected one or " + std::to_string(n));
}

ExcitationOptions MotionOptionsFor(const Robot& robot,
                                   const ExciteOptions& options,
                                   std::vector<std::string>* assumed) {
  // Hz, unless asked for: effects show in what is quick.
  const double highest = options.separate.empty() ? .5 : 1;
  ExcitationOptions motion;
  CheckWithin("duration", options.duration_s, .5, 1000);
  CheckWithin("periods", options.periods, 1, 100);
  motion.duration_s = options.duration_s;
  motion.periods = options.periods;
  const double period = options.duration_s / options.periods;
  motion.harmonics =
      std::max(5, static_cast<int>(std::lround(highest * period)));
  if (options.harmonics != 0) {
    CheckWithin("harmonics", options.harmonics, 2, 100);
    motion.harmonics = options.harmonics;
  }
  CheckWithin("log_rate", options.rate_hz, 1, 1e5);
  motion.rate_hz = options.rate_hz;
  motion.criterion = options.criterion;
  motion.limits = LimitsFor(robot, options.limits, assumed);
  motion.workspace = WorkspaceFor(robot, options, motion.limits);
  if (motion.workspace.empty()) {
    assumed->push_back("nothing is in the way (" + OptionName("floor") + ", " +
                       OptionName("obstacles") + ")");
  }
  motion.seed = options.seed;
  motion.progress = options.progress;
  return motion;
}

PostureOptions PostureOptionsFor(const Robot& robot,
                                 const ExciteOptions& options,
                                 std::vector<std::string>* assumed) {
  const StaticPoses& asked = *options.poses;
  CheckWithin("static_poses", asked.count, 1, 1000);
  PostureOptions postures;
  postures.count = asked.count;
  postures.instrument = asked.instrument;
  postures.criterion = options.criterion;
  postures.separate = options.separate;
  postures.gear_ratios = options.reading.gear_ratios;
  postures.noise = {asked.position_noise, asked.rotation_noise};
  std::vector<std::string> sentences;
  const MotionLimits limits = LimitsFor(robot, options.limits, &sentences);
  for (const std::string& sentence : sentences) {
    if (sentence.rfind("positions", 0) == 0) assumed->push_back(sentence);
  }
  postures.lower = limits.lower;
  postures.upper = limits.upper;
  postures.workspace = WorkspaceFor(robot, options, limits);
  postures.seed = options.seed;
  return postures;
}

}  // namespace armcal
