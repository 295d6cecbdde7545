#include "tests/blind/blind_case.h"

#include <glog/logging.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "model/plant/random_stream.h"
#include "model/robot_files/robot_reader.h"
#include "tests/blind/blind_arms.h"
#include "tests/blind/size_parameter.h"

namespace armcal {
namespace {

double Uniform(std::mt19937_64* random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(*random);
}

double LogUniform(std::mt19937_64* random, double low, double high) {
  return std::exp(Uniform(random, std::log(low), std::log(high)));
}

int Pick(std::mt19937_64* random, int count) {
  return std::uniform_int_distribution<int>(0, count - 1)(*random);
}

Robot ReadYaml(const std::string& text, uint64_t seed) {
  namespace fs = std::filesystem;
  const fs::path path =
      fs::temp_directory_path() / ("armcal_blind_" + std::to_string(seed) +
                                   "_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(path) << text;
  const Robot robot = ReadRobot(path.string(), {});
  fs::remove(path);
  return robot;
}

// The joints that a case moves; empty: all.
std::vector<int> MovingJoints(const BlindCase& blind) {
  if (blind.plan.excitation != Excitation::kTwoJoints) return {};
  const int first =
      static_cast<int>(blind.seed % (blind.robot.num_joints() - 1));
  return {first, first + 1};
}

// The joints of the case where an effect can be beside those that the plant
// has; -1: the whole robot. Those that move, where one of them can.
std::vector<int> PossibleJoints(const BlindCase& blind,
                                const HiddenEffect& kind,
                                const SimulatedRobot& plant,
                                const Eigen::VectorXd& parameters) {
  const EffectContext context = TypicalContext(blind.robot, 0);
  const bool whole = kind.scope == HiddenEffect::Scope::kRobot;
  const std::vector<int> moving = MovingJoints(blind);
  std::vector<int> joints, moved;
  for (int j = whole ? -1 : 0; j < (whole ? 0 : blind.robot.num_joints());
       ++j) {
    if (!WhyNotApplicable(kind, plant, j, parameters, context).empty()) {
      continue;
    }
    joints.push_back(j);
    if (std::count(moving.begin(), moving.end(), j)) moved.push_back(j);
  }
  return moved.empty() ? joints : moved;
}

// An effect of a kind at its usual size, in a form and on a joint drawn at
// random; without a kind where this robot cannot show it beside its others.
ChosenEffect DrawEffect(const BlindCase& blind, const HiddenEffect& kind,
                        std::mt19937_64* random) {
  SimulatedRobot plant;
  plant.robot = blind.robot;
  for (const ChosenEffect& other : blind.effects) {
    ApplyHiddenEffect(*other.kind, &plant, other.joint, other.parameters,
                      TypicalContext(blind.robot, 0));
  }
  ChosenEffect effect;
  effect.parameters = DrawParameters(kind, random);
  const int size = SizeParameterOf(kind).index;
  effect.parameters[size] =
      std::copysign(kind.parameters[size].usual, effect.parameters[size]);
  const auto joints = PossibleJoints(blind, kind, plant, effect.parameters);
  if (joints.empty()) return effect;
  effect.kind = &kind;
  effect.joint = joints[Pick(random, static_cast<int>(joints.size()))];
  return effect;
}

// Log-uniform within a bin, a twentieth of it away from its ends. What is
// larger than that bin is made smaller, what is smaller may do.
SizeAim DrawAim(const CasePlan& plan, std::mt19937_64* random) {
  constexpr double kLargest = 6;
  const int count = plan.highest_bin - plan.lowest_bin + 1;
  const int bin = plan.lowest_bin + Pick(random, count);
  const bool last = bin + 1 == kNumEnrBins;
  const double low = std::log(kEnrBins[bin]);
  const double high = std::log(last ? kLargest : kEnrBins[bin + 1]);
  const double margin = (high - low) / 20;
  return {std::exp(Uniform(random, low + margin, high - margin)),
          plan.least_enr(), last ? plan.most_enr() : kEnrBins[bin + 1]};
}

// False where the robot cannot show the planned effect.
bool DrawEffects(BlindCase* blind, std::mt19937_64* random) {
  blind->effects.clear();
  blind->aims.clear();
  if (!blind->plan.effect) return true;
  const auto& kinds = HiddenEffects();
  const HiddenEffect* kind = blind->plan.effect;
  const size_t count = blind->plan.stratum == Stratum::kTwo ? 2 : 1;
  while (blind->effects.size() < count) {
    const ChosenEffect effect = DrawEffect(*blind, *kind, random);
    if (effect.kind) {
      blind->effects.push_back(effect);
      blind->aims.push_back(DrawAim(blind->plan, random));
    } else if (blind->effects.empty()) {
      return false;
    }
    do {
      kind = &kinds[Pick(random, static_cast<int>(kinds.size()))];
    } while (!kind->in_catalogue || kind == blind->plan.effect);
  }
  return true;
}

SensorOptions DrawSensors(const Robot& robot, std::mt19937_64* random) {
  const int n = robot.num_joints();
  const Eigen::VectorXd usual = TypicalContext(robot, 0).torque;
  SensorOptions sensors;
  sensors.encoder_resolution =
      Eigen::VectorXd::Constant(n, LogUniform(random, 1e-6, 2e-5));
  sensors.encoder_noise = .6 * sensors.encoder_resolution;
  sensors.torque_noise = LogUniform(random, .005, .02) * usual;
  sensors.coloured_noise = LogUniform(random, .003, .01) * usual;
  sensors.noise_correlation = LogUniform(random, .02, .1);
  if (Uniform(random, 0, 1) < .3) sensors.jitter = 5e-4;
  if (Uniform(random, 0, 1) < .2) sensors.lost_share = .01;
  return sensors;
}

MotionOptions Motion(const BlindCase& blind, BlindLog log) {
  MotionOptions motion;
  motion.duration = log == BlindLog::kValidation ? 20 : blind.training_s;
  motion.seed = blind.seed;
  motion.run = static_cast<uint64_t>(log);
  motion.size = blind.plan.excitation == Excitation::kSmall ? .2 : .9;
  motion.speed = blind.plan.excitation == Excitation::kSlow ? .16 : 1;
  motion.joints = MovingJoints(blind);
  return motion;
}

}  // namespace

uint64_t BlindCaseSeed(BlindSet set, uint32_t seed, uint32_t index) {
  const uint64_t bit = set == BlindSet::kEvaluation ? 1ull << 63 : 0;
  CHECK_LT(seed, 1u << 31);
  return bit | (static_cast<uint64_t>(seed) << 32) | index;
}

bool Follows(const ClosedLoopRun& run) {
  return run.finite && run.tracking_rms.maxCoeff() < .05 &&
         run.tracking_peak < .2;
}

BlindCase DrawBlindCase(uint64_t seed, const CasePlan& plan, uint32_t attempt) {
  const uint32_t first = attempt / kDrawsOfAnArm * kDrawsOfAnArm;
  std::mt19937_64 random = RandomStream(seed, first, RandomPurpose::kCase);
  BlindCase blind;
  blind.seed = seed;
  blind.plan = plan;
  blind.trust = LogUniform(&random, .01, .06);
  blind.has_reference = Uniform(&random, 0, 1) < .4;
  blind.points = Uniform(&random, 0, 1) < .25;
  blind.zero_velocity = LogUniform(&random, .003, .012);
  const auto& arms = BlindArmNames();
  do {
    blind.arm = arms[Pick(&random, static_cast<int>(arms.size()))];
    blind.robot_yaml = BlindArmYaml(blind.arm, &random);
    blind.robot = ReadYaml(blind.robot_yaml, seed);
    blind.sensors = DrawSensors(blind.robot, &random);
  } while (!DrawEffects(&blind, &random));
  if (attempt == first) return blind;
  random = RandomStream(seed, attempt, RandomPurpose::kCase);
  while (!DrawEffects(&blind, &random)) {
  }
  return blind;
}

Scenario BlindScenario(const BlindCase& blind, BlindLog log,
                       const std::vector<ChosenEffect>& effects) {
  Scenario scenario;
  scenario.model = blind.robot;
  scenario.robot_error = blind.trust;
  scenario.zero_velocity = blind.zero_velocity;
  scenario.effects = effects;
  // What is held out is a motion of the other kind.
  const bool points = blind.points != (log == BlindLog::kValidation);
  const MotionOptions motion = Motion(blind, log);
  scenario.motion =
      WithStandstill(points ? PointToPointMotion(blind.robot, motion)
                            : FourierMotion(blind.robot, motion),
                     3, 1);
  scenario.loop.controller = DefaultController(
      blind.robot, scenario.motion.at(0).q, kUsualBandwidthHz);
  scenario.loop.sensors = blind.sensors;
  scenario.loop.sensors.seed = blind.seed;
  scenario.loop.sensors.run = static_cast<uint64_t>(log);
  scenario.seed = blind.seed;
  scenario.run = static_cast<uint64_t>(log);
  if (blind.misfit) {
    scenario.misfit =
        PlantMisfit(*blind.misfit, scenario.run, scenario.motion.duration);
  }
  return scenario;
}

Scenario QuietScenario(const BlindCase& blind, BlindLog log,
                       const std::vector<ChosenEffect>& effects) {
  Scenario scenario = BlindScenario(blind, log, effects);
  scenario.loop.sensors = SensorOptions();
  return scenario;
}

}  // namespace armcal
