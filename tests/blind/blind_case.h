#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/plant/hidden/scenario.h"
#include "tests/blind/case_plan.h"
#include "tests/blind/structured_misfit.h"

namespace armcal {

// Calibration cases are for setting thresholds, evaluation cases for judging,
// once. No seed of one is a seed of the other.
enum class BlindSet { kCalibration, kEvaluation };
// Of case `index` of the set drawn with `seed` (below 2^31): the top bit tells
// the sets apart.
uint64_t BlindCaseSeed(BlindSet set, uint32_t seed, uint32_t index);

// The ENR that an effect is to have, and what is near enough.
struct SizeAim {
  double target, low, high;
};

// A robot, what it hides, how it moves and how it is measured.
struct BlindCase {
  uint64_t seed = 0;
  CasePlan plan;
  std::string arm;
  std::string robot_yaml;       // what the diagnoser is given
  Robot robot;                  // the same, read
  double trust = .03;           // relative error of the robot file
  bool has_reference = false;   // a log of the robot before the effects
  bool has_torque = true;       // else logs hold commands and positions alone
  bool points = false;          // moves between points, not Fourier motion
  double training_s = 42;       // of motion in training and reference logs
  double zero_velocity = .005;  // rad/s
  std::vector<ChosenEffect> effects;
  std::vector<SizeAim> aims;  // of each effect
  SensorOptions sensors;
  std::optional<StructuredMisfit> misfit;  // nothing: the plant has none
};

// A case of that plan, its effects at their usual sizes. `attempt`: the same
// case with its effects on other joints or in other forms, or with other
// effects where the plan leaves them open; each kDrawsOfAnArm-th has another
// arm.
inline constexpr uint32_t kDrawsOfAnArm = 10;
BlindCase DrawBlindCase(uint64_t seed, const CasePlan& plan,
                        uint32_t attempt = 0);
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
