#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/segment.h"
#include "model/effects/effects.h"
#include "model/robot/robot.h"

namespace armcal {

// A term that a robot file gives no joint (friction of a frictionless model),
// as the logs say it is.
struct MissingTerm {
  const Effect* effect = nullptr;
  JointTerm joint_term;
  // n, SI units of the term; 0 where it would be negative.
  Eigen::VectorXd value;
  Eigen::VectorXd stddev;  // with the noise that is left when all are fitted
  // The value at which the term alone would make the joint's usual torque: how
  // large it may be where the file does not say.
  Eigen::VectorXd usual;
  double delta_chi2 = 0;  // by which chi^2 rises when it is left out
  // rms of what is left of each joint's torque with this and the terms
  // before it, N m or N.
  Eigen::VectorXd left;
};

struct MissingTerms {
  std::vector<MissingTerm> terms;  // empty: the file gives all
  Eigen::VectorXd without;         // rms left with none of them
  Robot robot;                     // the file's with all of them
};

// Viscous friction, Coulomb friction, armature and offsets, those of which the
// file gives none, fitted with the baseline to the segments.
MissingTerms FitMissingTerms(const Robot& robot, const BaselineOptions& options,
                             double bandwidth_hz,
                             const std::vector<GapSegment>& segments);

// Terms that the file gives, of friction and armature, and that these segments
// contradict: placeholders. With values of their own on all joints they leave
// less than half of the mean square that the file's leave within their trust,
// on three joints or on all of fewer, and each of them is asked for as a
// missing one is. None of a calibrated robot.
std::vector<JointTerm> FindPlaceholders(
    const Robot& robot, const BaselineOptions& options, double bandwidth_hz,
    const std::vector<GapSegment>& segments);

}  // namespace armcal
