#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/plant/hidden/scenario.h"

namespace armcal {

// Calibration cases are for setting thresholds, evaluation cases for judging,
// once. No seed of one is a seed of the other.
enum class BlindSet { kCalibration, kEvaluation };
// Of case `index` of the set drawn with `seed` (below 2^31): the top bit tells
// the sets apart.
uint64_t BlindCaseSeed(BlindSet set, uint32_t seed, uint32_t index);

enum class Excitation {
  kRich,      // all joints, most of their range and speed
  kSlow,      // all joints at a sixth of their speed
  kSmall,     // all joints, a fifth of their range
  kTwoJoints  // the others stand still
};
const char* ExcitationName(Excitation excitation);

// A robot, what it hides, how it moves and how it is measured.
struct BlindCase {
  uint64_t seed = 0;
  std::string arm;
  std::string robot_yaml;      // what the diagnoser is given
  Robot robot;                 // the same, read
  double trust = .03;          // relative error of the robot file
  bool has_reference = false;  // a log of the robot before the effects
  Excitation excitation = Excitation::kRich;
  bool points = false;          // moves between points, not Fourier motion
  double training_s = 42;       // of motion in training and reference logs
  double zero_velocity = .005;  // rad/s
  std::vector<ChosenEffect> effects;
  SensorOptions sensors;
};

// `attempt`: the same case with the sizes of its effects drawn again, from the
// fifth on with other effects.
BlindCase DrawBlindCase(uint64_t seed, uint32_t attempt = 0);
// Whether the arm follows its motion: a robot that does not would have stopped
// with an error and left no log to diagnose.
bool Follows(const ClosedLoopRun& run);

enum class BlindLog { kTraining, kValidation, kReference };
// The scenario of one log of the case with the effects `effects` of it (all, or
// what is left where others are switched off). Motions of the logs differ.
Scenario BlindScenario(const BlindCase& blind, BlindLog log,
                       const std::vector<ChosenEffect>& effects);
// The same without noise, for the size of effects.
Scenario QuietScenario(const BlindCase& blind, BlindLog log,
                       const std::vector<ChosenEffect>& effects);

}  // namespace armcal
