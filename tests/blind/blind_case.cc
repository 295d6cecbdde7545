#include "tests/blind/blind_case.h"

#include <glog/logging.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "model/plant/random_stream.h"
#include "model/robot_reader.h"
#include "tests/blind/blind_arms.h"

namespace armcal {
namespace {

constexpr uint32_t kAttemptsOfSize = 5;

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
  const Robot robot = ReadRobot(path, {});
  fs::remove(path);
  return robot;
}

// An effect of the wanted sort that this robot can show, beside `first` where
// there is one.
ChosenEffect DrawEffect(const Robot& robot, bool in_catalogue,
                        const ChosenEffect* first, std::mt19937_64* random) {
  const auto& kinds = HiddenEffects();
  const EffectContext context = TypicalContext(robot, 0);
  SimulatedRobot plant;
  plant.robot = robot;
  if (first) {
    ApplyHiddenEffect(*first->kind, &plant, first->joint, first->parameters,
                      context);
  }
  while (true) {
    ChosenEffect effect;
    effect.kind = &kinds[Pick(random, static_cast<int>(kinds.size()))];
    if (effect.kind->in_catalogue != in_catalogue) continue;
    effect.joint = effect.kind->scope == HiddenEffect::Scope::kJoint
                       ? Pick(random, robot.num_joints())
                       : -1;
    effect.parameters = DrawParameters(*effect.kind, random);
    if (WhyNotApplicable(*effect.kind, plant, effect.joint, effect.parameters,
                         context)
            .empty()) {
      return effect;
    }
  }
}

// None in 1 of 5 cases, one in 2 of 4 of the others, two or one that is out of
// the catalogue in a quarter each.
std::vector<ChosenEffect> DrawEffects(const Robot& robot,
                                      std::mt19937_64* random) {
  if (Uniform(random, 0, 1) < .2) return {};
  const double sort = Uniform(random, 0, 1);
  if (sort < .25) return {DrawEffect(robot, false, nullptr, random)};
  std::vector<ChosenEffect> effects = {
      DrawEffect(robot, true, nullptr, random)};
  if (sort < .75) return effects;
  do {
    effects.resize(1);
    effects.push_back(DrawEffect(robot, true, &effects[0], random));
  } while (effects[0].kind == effects[1].kind);
  return effects;
}

Excitation DrawExcitation(std::mt19937_64* random) {
  const double sort = Uniform(random, 0, 1);
  if (sort < .7) return Excitation::kRich;
  if (sort < .8) return Excitation::kSlow;
  return sort < .9 ? Excitation::kSmall : Excitation::kTwoJoints;
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
  motion.size = blind.excitation == Excitation::kSmall ? .2 : .9;
  motion.speed = blind.excitation == Excitation::kSlow ? .16 : 1;
  if (blind.excitation == Excitation::kTwoJoints) {
    const int n = blind.robot.num_joints();
    motion.joints = {static_cast<int>(blind.seed % (n - 1)),
                     static_cast<int>(blind.seed % (n - 1)) + 1};
  }
  return motion;
}

}  // namespace

const char* ExcitationName(Excitation excitation) {
  const char* const names[] = {"rich", "slow", "small", "two_joints"};
  return names[static_cast<int>(excitation)];
}

uint64_t BlindCaseSeed(BlindSet set, uint32_t seed, uint32_t index) {
  const uint64_t bit = set == BlindSet::kEvaluation ? 1ull << 63 : 0;
  CHECK_LT(seed, 1u << 31);
  return bit | (static_cast<uint64_t>(seed) << 32) | index;
}

bool Follows(const ClosedLoopRun& run) {
  return run.finite && run.tracking_rms.maxCoeff() < .05;
}

BlindCase DrawBlindCase(uint64_t seed, uint32_t attempt) {
  std::mt19937_64 random = RandomStream(seed, 0, RandomPurpose::kCase);
  BlindCase blind;
  blind.seed = seed;
  const auto& arms = BlindArmNames();
  blind.arm = arms[Pick(&random, static_cast<int>(arms.size()))];
  blind.robot_yaml = BlindArmYaml(blind.arm, &random);
  blind.robot = ReadYaml(blind.robot_yaml, seed);
  blind.trust = LogUniform(&random, .01, .06);
  blind.has_reference = Uniform(&random, 0, 1) < .4;
  blind.excitation = DrawExcitation(&random);
  blind.points = Uniform(&random, 0, 1) < .25;
  blind.zero_velocity = LogUniform(&random, .003, .012);
  blind.sensors = DrawSensors(blind.robot, &random);
  blind.effects = DrawEffects(blind.robot, &random);
  if (attempt == 0) return blind;
  random = RandomStream(seed, attempt, RandomPurpose::kCase);
  if (attempt >= kAttemptsOfSize) {
    blind.effects = DrawEffects(blind.robot, &random);
    return blind;
  }
  for (ChosenEffect& effect : blind.effects) {
    effect.parameters = DrawParameters(*effect.kind, &random);
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
  return scenario;
}

Scenario QuietScenario(const BlindCase& blind, BlindLog log,
                       const std::vector<ChosenEffect>& effects) {
  Scenario scenario = BlindScenario(blind, log, effects);
  scenario.loop.sensors = SensorOptions();
  return scenario;
}

}  // namespace armcal
