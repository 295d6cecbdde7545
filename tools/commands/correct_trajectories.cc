#include "tools/commands/correct_trajectories.h"

#include <gflags/gflags.h>

#include <cstdio>

#include "calib/refine/trajectory_refinement.h"
#include "tools/command.h"
#include "tools/flag_choices.h"
#include "tools/input_flags.h"

DEFINE_string(trajectory, "measured",
              "measured (recorded positions as they are, in weak rows), "
              "corrected (maximum likelihood: splines through all motions, "
              "fitted to positions and torques; for noisy encoders)");

namespace armcal {

namespace {

const FlagChoices<bool> kTrajectories("trajectory", {{"measured", false},
                                                     {"corrected", true}});

bool IsAskedFor(const FlagValues& flags) {
  return kTrajectories.Parse(flags.Text("trajectory"));
}

}  // namespace

void CheckTrajectoryFlag(const FlagValues& flags,
                         const LinearCalibrationOptions& options) {
  if (!IsAskedFor(flags)) return;
  const auto expect = [](bool fits, const std::string& flag) {
    if (fits) return;
    throw UsageError("--trajectory: found 'corrected', expected " + flag +
                     " with it");
  };
  expect(options.identification == Identification::kWeak,
         "--identification=weak");
  expect(options.solver == LinearSolver::kWeighted, "--solver=weighted");
  const RobustLoss loss = options.loss.value_or(RobustLoss::kHuber);
  expect(loss == RobustLoss::kHuber || loss == RobustLoss::kSquared,
         "--loss=huber or squared");
  expect(flags.Text("estimate") != "refined", "--estimate=linear or auto");
}

std::string CorrectTrajectories(const FlagValues& flags, const Robot& robot,
                                const LinearCalibrationOptions& options,
                                const LogSet& training,
                                const LogSet* validation,
                                LinearCalibration* result) {
  if (!IsAskedFor(flags) || !result->solved) return "";
  const TrajectoryRefinement refinement =
      RefineTrajectories(robot, options, *result, training, validation);
  *result = refinement.calibration;
  if (!refinement.refined) {
    return "trajectories not corrected: " + refinement.reason + "\n";
  }
  char text[100];
  std::snprintf(
      text, sizeof(text),
      "trajectories corrected (splines with knots every %.0f ms; %s)\n"
      "encoder noise  ",
      1e3 * refinement.knot_s, refinement.reason.c_str());
  std::string report = text;
  for (int i = 0; i < robot.num_joints(); ++i) {
    std::snprintf(text, sizeof(text), " %.2g", result->encoder_noise[i]);
    report += text;
  }
  return report + " rad (m)\n";
}

}  // namespace armcal
