#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "calib/excite/excitation.h"
#include "calib/excite/posture_design.h"
#include "calib/excite_options.h"
#include "model/text/input_error.h"

namespace armcal {

// What the options ask of a motion, but for the noise of its torques, and of
// postures. `assumed` gets a sentence where neither they nor the robot say.
// Throw OptionError, and InputError where the arm is nowhere clear.
ExcitationOptions MotionOptionsFor(const Robot& robot,
                                   const ExciteOptions& options,
                                   std::vector<std::string>* assumed);
PostureOptions PostureOptionsFor(const Robot& robot,
                                 const ExciteOptions& options,
                                 std::vector<std::string>* assumed);

// One number for all of n joints, or one for each.
Eigen::VectorXd PerJoint(const std::string& option,
                         const Eigen::VectorXd& values, int n);

// What `make` returns for the robot; where it cannot be (invalid_argument),
// InputError that names the robot. `where` precedes the reason.
template <class Make>
auto MakeFor(const Robot& robot, const ExciteOptions& options,
             const std::string& where, Make make) {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    const std::string& file = options.source.name;
    throw InputError(file.empty() ? robot.name : file, "", "",
                     where + error.what());
  }
}

}  // namespace armcal
