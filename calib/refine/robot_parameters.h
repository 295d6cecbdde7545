#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "model/robot/arm_geometry.h"
#include "model/robot/inertial_parameters.h"
#include "model/robot/robot.h"

namespace armcal {

// The numbers of a robot that a calibration may change, by the names that it
// gives them: "<link>.mass" and the links' other inertial parameters,
// "<joint>.viscous" and the joints' other terms, the parameters of ArmGeometry,
// of whose base only what torques see (pitch and roll).
class RobotParameters {
 public:
  explicit RobotParameters(const Robot& nominal);

  struct Parameter {
    std::string unit;
    double nominal;  // of the robot given
    double value;
    bool geometric = false;
  };
  const std::map<std::string, Parameter>& all() const { return parameters_; }
  bool Has(const std::string& name) const {
    return parameters_.count(name) > 0;
  }
  // A name that there is.
  void Set(const std::string& name, double value) {
    parameters_.at(name).value = value;
  }

  // The robot with these values.
  Robot Apply() const;

 private:
  double Value(const std::string& name) const {
    return parameters_.at(name).value;
  }

  Robot nominal_;
  ArmGeometry geometry_;
  std::map<std::string, Parameter> parameters_;
};

// Whether a parameter of this name is never negative: masses, friction,
// armature.
bool IsNeverNegative(const std::string& name);

}  // namespace armcal
