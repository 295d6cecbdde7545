#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/contacts/pulses.h"
#include "calib/diagnose/data/motion_range.h"
#include "calib/diagnose/select/regression.h"

namespace armcal {

// What the model alone leaves, in which pulses are looked for. What models lack
// as a rule (Discrepancy) is not fitted, since it is flexible enough to follow
// a push in a short log: it is as large as its prior says.
class PulseModel {
 public:
  // Of a fit that has a reference, given the effects' torque in its logs.
  PulseModel(const GapRegression& regression, const JointRows& torque);

  const Robot& robot() const { return robot_; }
  // `torque`: of the effects in `data`; `growth`: how much larger the variance
  // of what is left is than in the reference, per joint.
  PulseScan Scan(const GapData& data, const JointRows& torque,
                 const Eigen::VectorXd& growth) const;

 private:
  bool HasDryFriction(int joint) const;
  Eigen::MatrixXd ExtraStddev(const GapRows& rows,
                              const std::vector<Autoregression>& noise) const;

  Eigen::VectorXd x_;
  Robot robot_;
  const KnownEffects& known_;
  MotionRange range_;
  Eigen::MatrixXd covariance_;
  std::vector<Autoregression> noise_;
};

}  // namespace armcal
