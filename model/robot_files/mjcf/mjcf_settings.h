#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/text/xml_element.h"

namespace armcal {

// What an MJCF file says for all of it, in <compiler> and <option>.
struct MjcfSettings {
  enum class FromGeoms { kNever, kWhereAbsent, kAlways };

  bool degrees = true;
  std::string eulerseq = "xyz";
  bool autolimits = true;
  FromGeoms inertia_from_geoms = FromGeoms::kWhereAbsent;
  Eigen::Vector2d inertia_groups{0, 5};  // of geoms, first and last
  // Bounds that a body's mass and principal moments are raised to, and whether
  // impossible inertias are made round.
  double boundmass = 0;     // kg
  double boundinertia = 0;  // kg m^2
  bool balanceinertia = false;
  double totalmass = -1;  // kg, that all bodies are scaled to; -1: none
  Eigen::Vector3d gravity{0, 0, -9.81};  // m/s^2
  std::vector<std::string> notes;
};

// Throws InputError.
MjcfSettings ReadMjcfSettings(const XmlElement& root);

}  // namespace armcal
