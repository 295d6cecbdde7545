#pragma once

#include <tinyxml2.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "model/robot/joint.h"
#include "model/robot/joint_drive.h"

namespace armcal {

// Saturating parts (joint_drive.h) in MuJoCo's fields. A part of friction is a
// frictionloss, whose soft constraint is told the velocity at which it
// saturates: the largest is the joint's, the others are of fixed tendons
// JOINT_friction on this joint alone. One of negative force, which friction
// cannot be, is an actuator JOINT_push whose control has no gain: its bias
// grows with velocity up to its forcerange. `inverse` is the inverse of the
// inertia that the joint has in MuJoCo, 1/(kg m^2) or 1/kg.
void SetMjcfFriction(const std::vector<SaturatingPart>& parts, double inverse,
                     tinyxml2::XMLElement* joint);
void AddMjcfFrictionTendons(const Joint& joint,
                            const std::vector<SaturatingPart>& parts,
                            double inverse, tinyxml2::XMLElement* tendons);
void AddMjcfPushes(const Joint& joint, const std::vector<SaturatingPart>& parts,
                   tinyxml2::XMLElement* actuators);
// The steepest slope of the parts' sum over velocity.
double SteepestSlope(std::vector<SaturatingPart> parts);

// A part of a spring that saturates is the spring less the same spring with a
// dead band of the part's width (`springlength` of two values), which is of
// negative stiffness. One tendon JOINT_band has all of the springs, those
// numbered after it a dead band each.
void AddMjcfSpringTendons(const Joint& joint,
                          const std::vector<BoundedSpring>& springs,
                          tinyxml2::XMLElement* tendons);

// Makes a constraint ("limit", "friction") a spring and a damper of a force.
void SetMjcfSoftness(const std::string& constraint, double stiffness,
                     double damping, double inverse,
                     tinyxml2::XMLElement* element);

// Numbers with a space between them, all digits.
std::string ExactTexts(std::initializer_list<double> values);
// The first of several is NAME_kind, the next NAME_kind2.
std::string MjcfPartName(const Joint& joint, const char* kind, size_t k);

}  // namespace armcal
