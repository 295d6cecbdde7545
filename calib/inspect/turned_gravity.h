#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/logs/wiring.h"

namespace armcal {

// What joint terms (friction, armature, an offset) leave of torques beside the
// bodies that the robot file has, as they are, and beside none.
struct BodiesOfFile {
  BodiesOfFile(const TorqueFit& fit, const Eigen::MatrixXd& tau);

  // Squares beside the file's over squares beside none: of each joint that
  // moves, and of all of them together. Above 1 the bodies make it worse.
  Eigen::VectorXd joints;
  double all = 0;
  double percent_left = 0;  // rms over rms torque, beside the file's
};

// Whether the file's bodies are those of an arm whose gravity is the other way
// round: as it is they are worse than none, and so they explain more than half
// of the squares, both of all torques together and in the joints' geometric
// mean. A fit of bodies does not tell that where motions are slow: it mirrors
// every centre of mass, with masses that make up for the links' lengths, and
// leaves as little.
bool AreOfTurnedGravity(const BodiesOfFile& as_is, const BodiesOfFile& turned);

// That in words, for a person.
std::string EvidenceOf(const BodiesOfFile& as_is, const BodiesOfFile& turned);

}  // namespace armcal
