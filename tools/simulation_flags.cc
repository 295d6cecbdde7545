#include "tools/simulation_flags.h"

#include <gflags/gflags.h>

#include "model/plant/steady_loop.h"
#include "model/robot_files/controller_reader.h"
#include "tools/input_flags.h"
#include "tools/usage_error.h"

DEFINE_uint64(seed, 0, "of everything that is drawn at random");
DEFINE_string(
    controller, "",
    "`FILE` YAML with the controller's law (pd, p, cascade), rate, gains, "
    "limits, delay, lag; default: pd of 8 Hz per joint, slower where that "
    "rings");

namespace armcal {

uint64_t SeedFromFlags(const FlagValues& flags) {
  return flags.Natural("seed");
}

ControllerOptions ControllerFromFlags(const FlagValues& flags,
                                      const Robot& robot,
                                      const ReferenceMotion& motion,
                                      double bandwidth_hz) {
  if (!flags.Text("controller").empty()) {
    return ReadController(flags.Text("controller"), robot, motion.at(0).q);
  }
  return SteadyController(robot, motion, bandwidth_hz);
}

// One number for all joints, or one for each; none of them negative.
Eigen::VectorXd ParsePerJoint(const std::string& flag, const std::string& text,
                              int n) {
  std::vector<double> numbers = ParseNumbers(flag, text);
  if (numbers.size() == 1) numbers.assign(n, numbers[0]);
  const Eigen::VectorXd values =
      Eigen::Map<Eigen::VectorXd>(numbers.data(), numbers.size());
  if (values.size() == n && values.minCoeff() >= 0) return values;
  throw UsageError("--" + flag + ": found '" + text +
                   "', expected one number or " + std::to_string(n) +
                   ", none of them negative");
}

}  // namespace armcal
