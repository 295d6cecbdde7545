#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/gap_baseline.h"
#include "calib/gap_rows.h"

namespace armcal {

// How far torque is beyond what friction can hold, moving or at rest. A joint
// at rest holds any torque up to its Coulomb friction, whatever the direction,
// and so does one whose direction is doubtful: within it nothing is known.
struct FrictionExcess {
  // Thinned samples x n, means over kExcessTime, N m or N:
  Eigen::MatrixXd torque;    // recorded less the model's, friction left in it
  Eigen::MatrixXd friction;  // Coulomb, as the motion says; 0 at rest
  // (|torque| - Coulomb friction) / the noise's standard deviation.
  Eigen::MatrixXd deviations;
  Eigen::VectorXd coulomb;  // n, N m or N

  // The largest of all joints, per thinned sample.
  Eigen::VectorXd Largest() const { return deviations.rowwise().maxCoeff(); }
};

// The shortest push that is looked for, s.
inline constexpr double kExcessTime = .15;

// `residual`: recorded torque less that of the robot at x, friction included,
// thinned samples x n.
FrictionExcess ExcessOverFriction(const GapBaseline& baseline,
                                  const Eigen::VectorXd& x, const GapRows& rows,
                                  const Eigen::MatrixXd& residual);

// The largest value in every two seconds of every segment; `series`: thinned
// samples.
std::vector<double> BlockMaxima(const GapRows& rows,
                                const Eigen::VectorXd& series);

// What the largest of as many further maxima exceeds with this probability.
// Maxima above their median have an exponential tail (peaks over a threshold,
// Pickands 1975, in Gumbel's domain); that its scale is known from few of them
// makes what is predicted a Lomax distribution:
//   P(X > median + x) = 1/2 (1 + x / (m scale))^-m, m exceedances.
double PredictedMaximum(std::vector<double> maxima, double further,
                        double probability);

}  // namespace armcal
