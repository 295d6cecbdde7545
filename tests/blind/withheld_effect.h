#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "model/log_files/log.h"
#include "model/robot/robot.h"
#include "tests/blind/blind_label.h"

namespace armcal {

// One effect to put into the signals of a log that a real robot left, in a
// formula of its own. `size` is what an ENR is aimed with; its sign is drawn.
struct WithheldEffect {
  std::string name;       // as in model/effects
  int joint = -1;         // from 0; -1: the whole robot
  double size = 0;        // SI units
  Eigen::VectorXd shape;  // what else it needs, drawn once

  // For a label: the size first.
  std::vector<NamedValue> Values() const;
};
// "encoder_offset", ...
const std::vector<std::string>& WithheldEffectNames();
// Of that name at its usual size, in a log of this duration. `usual`: rms of
// the recorded torque of each joint, N m.
WithheldEffect DrawWithheldEffect(const std::string& name, const Robot& robot,
                                  const Eigen::VectorXd& usual, double duration,
                                  std::mt19937_64* random);
// Sizes between which the effect keeps its sense, of |size|.
struct SizeRange {
  double least, most;
};
SizeRange RangeOf(const WithheldEffect& effect, const Eigen::VectorXd& usual);

// What the log would have held. The robot's links need not be right, but for a
// payload and a contact its geometry has to be.
Log WithEffect(const Robot& robot, const WithheldEffect& effect,
               const Log& log);

}  // namespace armcal
