#include "calib/refine/far_masses.h"

#include <cmath>
#include <vector>

#include "model/text/enumeration.h"
#include "model/text/format.h"

namespace armcal {
namespace {

constexpr double kFar = 10;  // times the file's mass, or a tenth of it

}  // namespace

std::string WhatMassesAreFar(const NonlinearCalibration& refined) {
  if (!refined.solved) return "";
  std::vector<std::string> far;
  for (int i = 0; i < refined.robot.num_joints(); ++i) {
    const Link& link = refined.robot.links[i];
    const double mass = link.inertial.mass;
    const double file = refined.nominal.links[i].inertial.mass;
    if (!(file > 0) || IsDeclaredMassless(link)) continue;
    if (mass < kFar * file && file < kFar * mass) continue;
    far.push_back(link.name +
                  Format(" (%.3g kg, in the file %.3g)", mass, file));
  }
  if (far.empty()) return "";
  return "ten times the mass that the file says or more, or a tenth or less, "
         "was found for " +
         Enumeration(far) +
         ". If it carries no load that the file lacks, and these masses are no "
         "placeholders: are gravity's direction and the signs and units of "
         "torques and positions right (armcal inspect)?";
}

}  // namespace armcal
