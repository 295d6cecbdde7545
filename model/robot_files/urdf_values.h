#pragma once

#include <Eigen/Geometry>
#include <string>

#include "model/robot/inertial_parameters.h"
#include "model/robot/joint.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace armcal {

// Values as a URDF file has them, in SI units, set in its elements; what an
// element lacks is added.

// All digits: a robot is the same in every format.
std::string Digits(double x);
std::string Digits(const Eigen::Vector3d& v);

// The child called `name`, added at the end if there is none.
tinyxml2::XMLElement* Child(tinyxml2::XMLElement* parent, const char* name);

void SetOrigin(const Eigen::Isometry3d& X, tinyxml2::XMLElement* element);
// V: about Lo, expressed in L, of positive mass. URDF has inertia about the
// centre of mass.
void SetInertial(const InertialParameters& V, tinyxml2::XMLElement* link);
void SetDynamics(const Joint& joint, tinyxml2::XMLElement* element);

std::string XmlText(const tinyxml2::XMLDocument& document);

}  // namespace armcal
