#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

namespace armcal {

// The removed share: how far a gap shrinks on data that the model was not
// fitted to. Squares of what is left of the torque, in units of each joint's
// noise variance: samples (in time) x joints; NaN where a joint stands still.
struct HeldOutSquares {
  Eigen::MatrixXd nominal;  // the robot as its file has it
  Eigen::MatrixXd refit;    // with the baseline fitted
  Eigen::MatrixXd after;    // with the effects
};

// E, a mean over samples and joints of squares in units of the noise's. The
// floor is the noise: 1, or what is left where that is less. NaN where nothing
// was held out, which agrees with nothing.
struct GapFigures {
  bool known() const { return !std::isnan(after); }

  double nominal = NAN;
  double refit = NAN;
  double after = NAN;
  double floor = 1;
  // 100 (refit - after) / (refit - floor); NaN where nothing can be removed.
  double removed_percent = NAN;
  double removed_from_nominal_percent = NAN;
  // 100 (nominal - refit) / (nominal - floor): by fitting numbers alone.
  double refit_removes_percent = NAN;
  double ci95[2] = {NAN, NAN};          // of removed_percent
  double nominal_ci95[2] = {NAN, NAN};  // of removed_from_nominal_percent
  Eigen::MatrixXd joints;               // n x 3 rms: nominal, refit, after
};

// Of all that are no NaN; 1 where there are none.
double MeanSquare(const Eigen::MatrixXd& squares);

// Sums over joints at each time, with how many of them moved: a mean over
// joints and samples is then the ratio of two sums over time, which blocks of
// the bootstrap may take apart.
struct SumsOverJoints {
  Eigen::VectorXd sum;
  Eigen::VectorXd count;  // of joints that moved
};
SumsOverJoints SumJoints(const Eigen::MatrixXd& squares);

// `floor_stddev`: how well the floor is known, relative; intervals hold it.
GapFigures RemovedShareFigures(const HeldOutSquares& squares,
                               double floor_stddev, std::uint64_t seed);

}  // namespace armcal
