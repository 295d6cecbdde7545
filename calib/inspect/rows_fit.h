#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/logs/uniform_series.h"
#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// Motion and torques of a series at these of its samples.
WiringSamples SamplesAt(const UniformSeries& series,
                        const std::vector<int>& samples);

// An arm, its inertias free (TorqueFit), that is fitted to the torques of some
// samples of a log, and what it says of the torque at others.
class RowsFit {
 public:
  static constexpr size_t kFewest = 60;  // samples

  // Of many samples some, evenly.
  RowsFit(const Robot& robot, const UniformSeries& series,
          std::vector<int> samples);

  // What a joint needs; `own`: with its friction, offset and armature.
  Eigen::VectorXd Torque(const Motion& motion, int joint, bool own) const {
    return Torque(fits_[0], motion, joint, own);
  }
  // The variance of a recorded torque about that, if it is right: as in the
  // fitted samples, and that of the fit itself, as the arm may be where it is
  // nowhere else. Without `own` terms a constant is no difference.
  double VarianceAbout(const Motion& motion, int joint, bool own) const;

  double coulomb(int joint) const { return fits_[0].own[4 * joint + 1]; }
  // Of a joint's torque in the fitted samples at which it moves.
  double mean(int joint) const { return mean_[joint]; }
  double variance(int joint) const { return variance_[joint]; }
  // For how long a joint moves in the given samples, s.
  double time_in_motion(int joint) const { return moved_[joint]; }

 private:
  struct FittedArm {
    Robot robot;          // its links
    Eigen::VectorXd own;  // viscous, Coulomb, offset, armature of each joint
  };
  FittedArm FitTo(const UniformSeries& series,
                  const std::vector<int>& samples) const;
  static Eigen::VectorXd Torque(const FittedArm& arm, const Motion& motion,
                                int joint, bool own);
  void SetFigures(const WiringSamples& samples, double times, double dt);

  const Robot& robot_;
  std::vector<FittedArm> fits_;  // to all samples, and to two halves of them
  // Per joint; what the fit leaves, (N m)^2 or N^2.
  Eigen::VectorXd left_, mean_, variance_, moved_;
};

}  // namespace armcal
