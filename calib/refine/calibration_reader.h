#pragma once

#include <string>
#include <vector>

#include "calib/numerics/json_value.h"
#include "model/dynamics/joint_term.h"
#include "model/log_files/time_base.h"
#include "model/robot/robot.h"

namespace armcal {

// What a calibration.json says of a robot.
struct CalibratedRobot {
  Robot robot;  // the robot file's, with the refined parameters
  // How each joint's Coulomb friction changes sign.
  std::vector<CoulombTransition> transitions;
  double bandwidth_hz = 0;
  bool converged = false;
  // It was calibrated on: as they were named, and the part of their time.
  std::vector<std::string> logs;
  std::vector<TimeRange> log_ranges;

  // Whether it was fitted to some of this part of a log, the same file by
  // whatever path from the current folder.
  bool Saw(const std::string& log, const TimeRange& range) const;
};

// Throws InputError unless `root` is a calibration of this robot.
void ExpectCalibrationOf(const Robot& robot, const JsonValue& root);

// Reads the calibration.json that `armcal calibrate` wrote for `nominal`, the
// robot of the same robot file. Lengths that were recovered and geometry that
// was refined are applied as the inertial parameters and the joints' terms are;
// where the instrument of pose measurements stood is not the robot's.
//
// Throws InputError with the file, the key, its value and what was expected:
// text that is no JSON or none of ours, a key that is missing or of another
// type, a linear estimate only, other joints or links than the robot's, a
// negative mass, friction or armature, Coulomb friction without the way it
// changes sign, a prior that is not the robot file's value (the file has
// changed since), a unit or a name that is not known.
CalibratedRobot ReadCalibration(const std::string& path, const Robot& nominal);

}  // namespace armcal
