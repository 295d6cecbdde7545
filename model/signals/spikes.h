#pragma once

#include <Eigen/Core>

namespace armcal {

// Replaces single samples that stick out of a signal by what is around them:
// where a sample differs from the median of the five around it by more than 8
// times what such differences usually are (their 90th percentile, as a standard
// deviation), it becomes that median. Steps and peaks of three samples or more
// stay, and so does everything where most samples equal their neighbours.
// Columns of x are treated apart. Returns which samples were replaced.
Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> RemoveSpikes(
    Eigen::MatrixXd* x);

// Samples that stick out of a signal that is slow beside them: of residuals,
// where RemoveSpikes would take motion for noise.
struct Outlying {
  Eigen::Array<bool, Eigen::Dynamic, 1> marked;
  Eigen::VectorXd level;  // the median of the unmarked samples around each
  double deviation = 0;   // standard, of samples about their level
  double limit = 0;       // the difference from the level that marks a sample
};

// Marks samples that differ by more than 8 deviations, and by more than
// `least`, from the median of the `reach` unmarked ones on either side. The
// deviation is robust against a fifth of outliers; runs of up to `reach`
// samples are found, longer ones are a change of level.
Outlying FindOutlying(const Eigen::VectorXd& x, int reach, double least);

// Value k of x on the straight line between the nearest unmarked samples on
// either side; the nearer one at an end, x[k] where all are marked.
double Bridge(const Eigen::VectorXd& x, Eigen::Index k,
              const Eigen::Array<bool, Eigen::Dynamic, 1>& marked);
// The value of that of these two which is nearer to x[k]: if k is before or
// after a step of x between them, this is what x[k] is about.
double NearerEnd(const Eigen::VectorXd& x, Eigen::Index k,
                 const Eigen::Array<bool, Eigen::Dynamic, 1>& marked);

}  // namespace armcal
