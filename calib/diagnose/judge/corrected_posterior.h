#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/corrected_robot.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// What a diagnosis leaves open of the robot that it corrected: a Gaussian of
// the model's values and of the parameters of the effects together.
struct CorrectedPosterior {
  struct Parameter {
    int effect, index;
  };

  std::vector<int> columns;           // of the baseline, that are open
  std::vector<Parameter> parameters;  // of the effects, likewise
  Eigen::VectorXd mean;               // of columns, then of parameters
  Eigen::MatrixXd covariance;
  // What the mean is of: all values of the baseline, all effects.
  Eigen::VectorXd model;
  std::vector<GapCandidate> effects;

  // The same with other values of what is open.
  Eigen::VectorXd ModelAt(const Eigen::VectorXd& values) const;
  std::vector<GapCandidate> EffectsAt(const Eigen::VectorXd& values) const;
};

// Of a fit's refined effects and the model given them, which are the mean.
// Nuisances that no robot has are integrated out: when friction turns, and what
// models lack as a rule, which so makes the robot less certain than noise alone
// does.
CorrectedPosterior PosteriorOf(const GapFit& fit);

}  // namespace armcal
