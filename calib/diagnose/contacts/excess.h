#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/thresholds.h"

namespace armcal {

// How far torque is beyond what friction can hold, moving or at rest. A joint
// at rest holds any torque up to its Coulomb friction, whatever the direction,
// and so does one whose direction is doubtful: within it nothing is known.
struct FrictionExcess {
  // Thinned samples x n, means over Limits().shortest_push, N m or N:
  Eigen::MatrixXd torque;    // recorded less the model's, friction left in it
  Eigen::MatrixXd friction;  // Coulomb, as the motion says; 0 at rest
  // (|torque| - friction) / the noise's standard deviation; the friction is
  // Coulomb, or static where the torque drives a joint out of a rest.
  Eigen::MatrixXd deviations;
  Eigen::VectorXd coulomb;  // n, N m or N

  // The largest of all joints, per thinned sample.
  Eigen::VectorXd Largest() const { return deviations.rowwise().maxCoeff(); }
};

// `residual`: recorded torque less that of the robot at x, friction included,
// thinned samples x n.
FrictionExcess ExcessOverFriction(const GapBaseline& baseline,
                                  const Eigen::VectorXd& x, const GapRows& rows,
                                  const Eigen::MatrixXd& residual);

// How long the blocks are that maxima are taken of: 2 s, and no longer than a
// tenth of the rows' time, but twice Limits().shortest_push.
double BlockTime(const GapRows& rows);
// The largest value in every block of every segment; `series`: thinned samples.
std::vector<double> BlockMaxima(const GapRows& rows, double block,
                                const Eigen::VectorXd& series);

}  // namespace armcal
