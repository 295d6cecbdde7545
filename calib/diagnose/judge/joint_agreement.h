#pragma once

#include <cstddef>
#include <vector>

#include "calib/diagnose/select/fit.h"

namespace armcal {

// Whether joints tell the k-th effect of a fit alike, if it is of all of them.
//
// How far they are from it is, of chi^2, by what each would rather have it,
// rows whitened as the evidence is,
//   chi_squared = sum_j d_j' A_j d_j - d' (sum_j A_j) d,
//   d_j = A_j^-1 P_j' r_j,  A_j = P_j' P_j,
// r_j joint j's residual given all effects as refined, P_j its rows of this
// one's columns, d the mean of all joints, the baseline free but for the delay
// of all joints that it has itself: with that one free, a delay would show in
// no joint. `delta_chi2`: what it explains of chi^2 so, x' (sum_j A_j) x of its
// sizes x. `freedom`: of the chi squared that this is where joints agree; 0
// where one joint alone tells.
//
// A joint that has the sizes x_j by itself sees the effect where x_j' A_j x_j
// is more than chance.
struct JointAgreement {
  // The effect's only linear parameter, in its own unit, as one joint by itself
  // has it.
  struct JointSize {
    int joint = 0;
    double value = 0, stddev = 0;
  };

  double chi_squared = 0;
  double delta_chi2 = 0;
  int freedom = 0;
  // Joints that move, also those whose torque tells nothing: a joint that
  // nothing drives cannot confirm what another one has by itself.
  int moving = 0;
  int seen_by = 0;  // joints
  // Of joints that tell; empty where the effect has several parameters.
  std::vector<JointSize> joints = {};

  // Whether they differ by more than chance (three standard deviations), and by
  // more than `form`: what of its delta chi^2 an effect's form may have wrong.
  bool Differ(double form) const;
  // Whether one joint alone sees what all that move should.
  bool IsOfOneJoint() const { return moving > 1 && seen_by < 2; }
  // By how much the variance of the common size is larger than the joints' own
  // deviations make it, since each joint has a size of its own, in its unit
  // squared. With the weights w_j = 1 / stddev_j^2 and Q = chi_squared, sizes
  // scatter from joint to joint by
  //   tau^2 = max(0, (Q - (joints - 1)) / (sum w - sum w^2 / sum w))
  // (DerSimonian and Laird 1986), of which the weighted mean has
  //   tau^2 sum w^2 / (sum w)^2.
  // 0 where one joint alone tells, or the effect has several parameters.
  double VarianceBetweenJoints() const;
};

JointAgreement JointAgreementOn(const GapFit& fit, size_t k);

}  // namespace armcal
