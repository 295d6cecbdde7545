#include "calib/verify/rollout_comparison.h"

#include <algorithm>

#include "calib/numerics/undefined.h"
#include "calib/verify/arm_engine.h"

namespace armcal {
namespace {

constexpr double kIntegrated = 1e-5;  // rad, m: of RolloutOptions::tolerance

// Medians over windows, since a window in which the arm is unstable or touches
// something has an error as large as one likes.
RolloutComparison Compare(const Robot& robot, const Rollouts& rollouts,
                          const std::string& unit, bool calibrated,
                          std::uint64_t seed) {
  const std::vector<int> joints = JointsWithUnit(robot, unit);
  RolloutComparison c;
  c.window_s = rollouts.window_s;
  c.unit = unit;
  c.windows = static_cast<int>(rollouts.windows.size());
  c.standstill = rollouts.standstill;
  c.before_diverged = rollouts.NumDiverged(0);
  c.before = MedianError(rollouts, 0, joints, seed);
  c.before_by_engine = MedianErrorsByEngine(rollouts, 0, joints);
  c.before_velocity_rms = MedianVelocityError(rollouts, 0, joints);
  c.after_velocity_rms = kNaN;
  if (calibrated) {
    c.after_diverged = rollouts.NumDiverged(1);
    c.after = MedianError(rollouts, 1, joints, seed);
    c.after_by_engine = MedianErrorsByEngine(rollouts, 1, joints);
    c.ratio = MedianRatio(rollouts, 1, 0, joints, seed);
    c.after_velocity_rms = MedianVelocityError(rollouts, 1, joints);
  }
  for (const int j : joints) {
    c.joints.push_back(
        {robot.links[j].joint.name, MedianError(rollouts, 0, {j}, seed).value,
         calibrated ? MedianError(rollouts, 1, {j}, seed).value : kNaN});
  }
  return c;
}

}  // namespace

bool RolloutComparison::is_judged() const {
  return window_s == kJudgedWindow && ratio && ratio->can_judge() &&
         (after->value >= kIntegrated || before.value >= kIntegrated);
}

// Both robots run over the same windows, so that their ratio is of pairs: what
// makes a window hard is in both.
RolloutComparisons CompareRollouts(const Robot& file,
                                   const CalibratedRobot* calibrated,
                                   const RolloutOptions& options,
                                   double bandwidth_hz, std::uint64_t seed,
                                   const LogSet& logs) {
  std::vector<CoulombTransition> transitions(file.num_joints());
  if (calibrated != nullptr) transitions = calibrated->transitions;
  std::vector<RolloutModel> models = {{file, transitions}};
  RolloutComparisons result;
  result.before_in_simbody = MakeArmEngine(file).is_simbody;
  if (calibrated != nullptr) {
    models.push_back({calibrated->robot, transitions});
    result.after_in_simbody = MakeArmEngine(calibrated->robot).is_simbody;
  }
  for (const Rollouts& rollouts :
       RollOut(models, options, bandwidth_hz, logs)) {
    result.simulations +=
        static_cast<int>(rollouts.windows.size() * models.size());
    result.in_simbody += rollouts.in_simbody;
    result.unfinished_in_simbody += rollouts.unfinished_in_simbody;
    result.compared += rollouts.compared;
    result.simbody_difference =
        std::max(result.simbody_difference, rollouts.simbody_difference);
    for (const char* unit : {"rad", "m"}) {
      if (JointsWithUnit(file, unit).empty()) continue;
      result.windows.push_back(
          Compare(file, rollouts, unit, calibrated != nullptr, seed));
    }
  }
  return result;
}

}  // namespace armcal
