#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/changes/hypothesis.h"
#include "calib/diagnose/changes/series.h"
#include "model/robot/robot.h"

namespace armcal {

// What of a robot changes together.
enum class ChangedPart {
  kAllFriction,  // about one factor for all: temperature, lubricant
  kFriction,     // of one joint
  kOffset,
  kArmature,
  kTorqueScale,  // of one joint: its torque constant, its sensor
  kAllScales,    // about one factor for all torques: motors' temperature, units
  kMass          // fixed to a link, or off it
};
// "friction of all joints".
const char* ChangedPartName(ChangedPart part);

struct NamedHypothesis {
  ChangedPart part;
  int joint = -1;  // or the link that it moves; -1: all
  ChangeHypothesis change;
  // What is told of it: amounts with names and units, told times the numbers
  // of the hypothesis.
  std::vector<std::string> names, units;
  Eigen::MatrixXd told;
  // What each number makes of the parameters (LogSeries::torque is 1); of a
  // torque's scale, which changes no parameter of the arm, nothing.
  std::vector<Eigen::MatrixXd> directions;  // in each log
};

// All that is looked for in a series, competing with each other. Viscous and
// Coulomb friction change by themselves or together; a mass by its moments, or
// also by its inertia. `levels`: the parameters that friction is relative to,
// in each log (parameters x logs): a factor on all joints' friction acts on
// what it is after other changes.
std::vector<NamedHypothesis> MakeHypotheses(const Robot& robot,
                                            const LogSeries& series,
                                            const Eigen::MatrixXd& levels);

}  // namespace armcal
