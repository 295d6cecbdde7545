#include "model/robot_files/mjcf_saturation.h"

#include <algorithm>
#include <cmath>

#include "model/text/exact_text.h"

namespace armcal {
namespace {

using tinyxml2::XMLElement;

// MuJoCo's impedance d of the soft constraints: the acceleration of the joint
// counts d / (1 - d) as much as the inertia that they act on, once for each
// part. Of ten parts that is 1 %.
constexpr double kImpedance = .001;
// MuJoCo takes a positive third number of an affine bias for a damping ratio,
// where the first number of the gain is minus the second one of the bias. N
// m/rad that nobody sees tell them apart.
constexpr double kNoStiffness = -1e-9;

// The part that the joint itself has; all where none brakes.
size_t Largest(const std::vector<SaturatingPart>& parts) {
  const auto less = [](const auto& a, const auto& b) {
    return a.force < b.force;
  };
  return std::max_element(parts.begin(), parts.end(), less) - parts.begin();
}

void SetFriction(const SaturatingPart& part, double inverse,
                 XMLElement* element) {
  element->SetAttribute("frictionloss", ExactText(part.force).c_str());
  SetMjcfSoftness("friction", 0, part.force / part.width, inverse, element);
}

XMLElement* AddTendon(const Joint& joint, const char* kind, size_t k,
                      XMLElement* tendons) {
  XMLElement* tendon = tendons->InsertNewChildElement("fixed");
  tendon->SetAttribute("name", MjcfPartName(joint, kind, k).c_str());
  XMLElement* on = tendon->InsertNewChildElement("joint");
  on->SetAttribute("joint", joint.name.c_str());
  on->SetAttribute("coef", "1");
  return tendon;
}

// -1 alone would stand for a length that MuJoCo works out.
double SpringLength(double q) { return q == -1 ? std::nextafter(q, 0) : q; }

void AddSpring(double stiffness, double low, double high, XMLElement* tendon) {
  tendon->SetAttribute("stiffness", ExactText(stiffness).c_str());
  tendon->SetAttribute(
      "springlength",
      ExactTexts({SpringLength(low), SpringLength(high)}).c_str());
}

}  // namespace

std::string ExactTexts(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : " ") + ExactText(value);
  }
  return text;
}

std::string MjcfPartName(const Joint& joint, const char* kind, size_t k) {
  return joint.name + "_" + kind + (k == 0 ? "" : std::to_string(k + 1));
}

// MuJoCo's reference acceleration is -damping v / d - stiffness x / d, and the
// force is it over (1 - d) / d times the inverse inertia.
void SetMjcfSoftness(const std::string& constraint, double stiffness,
                     double damping, double inverse, XMLElement* element) {
  const double scale = (1 - kImpedance) * inverse;
  // A format of two numbers below 0; friction has no stiffness and ignores it.
  element->SetAttribute(
      ("solref" + constraint).c_str(),
      ExactTexts({stiffness > 0 ? -stiffness * scale : -1, -damping * scale})
          .c_str());
  element->SetAttribute(("solimp" + constraint).c_str(),
                        ExactTexts({kImpedance, kImpedance, 1}).c_str());
}

void SetMjcfFriction(const std::vector<SaturatingPart>& parts, double inverse,
                     XMLElement* joint) {
  if (!parts.empty()) SetFriction(parts[Largest(parts)], inverse, joint);
}

void AddMjcfFrictionTendons(const Joint& joint,
                            const std::vector<SaturatingPart>& parts,
                            double inverse, XMLElement* tendons) {
  size_t count = 0;
  for (size_t k = 0; k < parts.size(); ++k) {
    if (k == Largest(parts) || parts[k].force < 0) continue;
    SetFriction(parts[k], inverse,
                AddTendon(joint, "friction", count++, tendons));
  }
}

void AddMjcfPushes(const Joint& joint, const std::vector<SaturatingPart>& parts,
                   XMLElement* actuators) {
  size_t count = 0;
  for (const SaturatingPart& part : parts) {
    if (part.force >= 0) continue;
    XMLElement* push = actuators->InsertNewChildElement("general");
    push->SetAttribute("name", MjcfPartName(joint, "push", count++).c_str());
    push->SetAttribute("joint", joint.name.c_str());
    push->SetAttribute("gainprm", "0");
    push->SetAttribute("biastype", "affine");
    push->SetAttribute(
        "biasprm",
        ExactTexts({0, kNoStiffness, -part.force / part.width}).c_str());
    push->SetAttribute("forcelimited", "true");
    push->SetAttribute("forcerange",
                       ExactTexts({part.force, -part.force}).c_str());
  }
}

// Of the line between two knots are all parts that saturate behind it.
double SteepestSlope(std::vector<SaturatingPart> parts) {
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return a.width > b.width; });
  double slope = 0, steepest = 0;
  for (const SaturatingPart& part : parts) {
    slope += part.force / part.width;
    steepest = std::max(steepest, slope);
  }
  return steepest;
}

void AddMjcfSpringTendons(const Joint& joint,
                          const std::vector<BoundedSpring>& springs,
                          XMLElement* tendons) {
  size_t count = 0;
  for (const BoundedSpring& spring : springs) {
    const double at = spring.centre;
    double all = 0;
    for (const auto& part : spring.parts) all += part.force / part.width;
    AddSpring(all, at, at, AddTendon(joint, "band", count++, tendons));
    for (const SaturatingPart& part : spring.parts) {
      AddSpring(-part.force / part.width, at - part.width, at + part.width,
                AddTendon(joint, "band", count++, tendons));
    }
  }
}

}  // namespace armcal
