#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/logs/wiring.h"
#include "model/robot/robot.h"

namespace armcal {

// Samples in two halves, each of which judges a fit (TorqueFit) to the other:
// they are cut into 32 stretches, of which every second one is a half.
class HeldOutHalves {
 public:
  HeldOutHalves(const Robot& robot, const WiringSamples& samples);

  const WiringSamples& half(int h) const { return halves_[h]; }
  const TorqueFit& fit(int h) const { return fits_[h]; }
  // The half's rows of something that has one for each sample.
  Eigen::MatrixXd Rows(const Eigen::MatrixXd& of_samples, int h) const {
    return of_samples(rows_[h], Eigen::all);
  }

 private:
  std::vector<int> rows_[2];
  std::vector<WiringSamples> halves_;
  std::vector<TorqueFit> fits_;
};

// What a fit of the arm leaves of torques: of each half by the fit to the
// other, which has not seen it, and of all samples by the fit to them. Squares
// over those of the torque.
struct HeldOutFit {
  Eigen::Matrix<double, 3, Eigen::Dynamic> joints;  // per joint
  Eigen::Vector3d all;                              // of all joints together
  double residual_percent = 0;  // rms over rms torque, of both halves
  // Per joint, what the torque varies by about its mean: squares over those of
  // the torque. An offset alone leaves as much.
  Eigen::VectorXd variation;
};
HeldOutFit FitHeldOut(const Robot& robot, const WiringSamples& samples);

// The same with joint j's figures at column[j]: those of a logged torque are
// at one place then, whichever joint it is read as the torque of.
HeldOutFit OfColumns(const HeldOutFit& fit, const std::vector<int>& column);

// Whether another reading fits clearly better, in both halves and all samples:
// what is wrong with the columns of some joints (`of`), from what all have.
bool IsClearlyBetter(const HeldOutFit& as_is, const HeldOutFit& changed,
                     const std::vector<int>& of);
// Whether the other reading is the first that explains how joint j's torque
// varies: more than half of that is left as it is, and less than half by the
// other, which leaves less than half of what was left, in both halves and all
// samples. No wrong reading of a right log does that, whatever else its model
// lacks: as it is, friction and load of the joint explain its torque.
bool IsFirstToExplain(const HeldOutFit& as_is, const HeldOutFit& changed,
                      int j);
// Whether another sign of joint j cross-validates better: of all torques
// together, and of joint j's own, which holds the friction and the load that
// the sign is told by, the mean of both halves' squares falls by the factor
// that IsBetterForAll asks of a mean, as those of all samples do. Each half has
// to agree. Means over all joints would ask the more of one sign the more
// joints an arm has.
bool IsBetterSign(const HeldOutFit& as_is, const HeldOutFit& changed, int j);
// IsClearlyBetter of something that concerns all joints alike, such as a delay.
bool IsBetterForAll(const HeldOutFit& as_is, const HeldOutFit& changed);
// Whether the squares of all torques together, in which the joints that work
// most count most, are lower by the factor that IsBetterForAll asks of the
// joints' mean, in which each counts alike: in both halves and all samples.
bool IsBetterInTotal(const HeldOutFit& as_is, const HeldOutFit& changed);

}  // namespace armcal
