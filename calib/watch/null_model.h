#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/watch/hypotheses.h"

namespace armcal {

// The equations of one instant, less what the calibrated parameters explain.
struct WatchRow {
  double t = 0;
  Eigen::MatrixXd A;  // n x (parameters + 6): U and a wrench's columns
  Eigen::VectorXd r;  // n, N m or N
  Eigen::VectorXd crossing, standing;  // causal_rows.h
};

struct NullOptions {
  double bandwidth_hz = 20;
  double row_step_s = .01;            // between rows that are kept
  double false_alarms_per_hour = .1;  // of all tests together
};

// What residuals do where nothing has changed, learned from the first seconds
// of a log: variances, how alike successive rows are, how far their tails
// reach, and how parameters seem to wander because the model is not quite the
// robot. Thresholds follow from these and from how many false alarms an hour
// are wanted; the source has each formula.
struct NullModel {
  Eigen::VectorXd sigma2;     // per joint, (N m)^2 or N^2, of one row
  Eigen::VectorXd crossing2;  // what is added where friction changes sign
  Eigen::VectorXd standing2;  // .. while the joint stands
  double standing_rows = 0;   // that one such torque is the same in
  // Variance of means of rows over that of as many independent ones, >= 1.
  Eigen::VectorXd long_run;
  // Per joint, in standard deviations of one row: of a contact's torque, and of
  // one while the joint's friction changes its sign, whose residual is no noise
  // but a law that is not quite the robot's, with tails of its own.
  Eigen::VectorXd threshold, crossing_threshold;
  // Of a change's log Bayes factor.
  double log_bayes_threshold = 0;
  // Covariance of what parameters seem to change from second to second.
  Eigen::MatrixXd wander;

  // Of residuals, but for what parameters add (causal_rows.h has the
  // arguments).
  Eigen::VectorXd Variance(const Eigen::VectorXd& crossing,
                           const Eigen::VectorXd& standing) const;
  // Beyond which residual of a row a contact is told, if its standard
  // deviations are these.
  Eigen::VectorXd Limit(const Eigen::VectorXd& crossing,
                        const Eigen::VectorXd& stddev) const;
  // 1 / variance that a row counts as among its neighbours.
  Eigen::VectorXd Weight(const WatchRow& row) const;
};

// Learns from rows; *belief, the calibration's, becomes what these rows and it
// say of the parameters together. The change of a payload or of friction since
// the calibration is free to be there, and is then no noise.
NullModel LearnNull(const std::vector<WatchRow>& rows, const WatchModel& model,
                    const std::vector<WatchHypothesis>& hypotheses,
                    const NullOptions& options, ParameterBelief* belief);

// The level which a stationary Gaussian signal of unit variance and two equal
// poles of `bandwidth_hz` crosses, to either side, `rate` times a second
// (Rice 1945: v0 exp(-h^2 / 2) upward, with v0^2 = the mean square of its
// derivative over 4 pi^2, here bandwidth_hz^2).
double RiceLevel(double bandwidth_hz, double rate);

}  // namespace armcal
