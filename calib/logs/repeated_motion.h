#pragma once

#include <Eigen/Core>
#include <optional>

namespace armcal {

// Positions at rising times, samples in rows.
struct RecordedMotion {
  Eigen::VectorXd t;  // s
  Eigen::MatrixXd q;  // rad or m
};

// The least lag, of at least `least_lag` s, at which `later` does again what
// `earlier` did: later(t + lag) = earlier(t) to 1 % of each joint's motion,
// where both are known, for 2 s or longer and not at rest. The two may be the
// same motion. Lags are searched every 0.05 s, then at the step of `earlier`.
std::optional<double> FindRepeat(const RecordedMotion& earlier,
                                 const RecordedMotion& later, double least_lag);

// The sample of `t` nearest to `time`.
Eigen::Index NearestSample(const Eigen::VectorXd& t, double time);

}  // namespace armcal
