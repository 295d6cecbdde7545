#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/screen.h"

namespace armcal {

// What a model leaves of each joint's torque, as evidence for or against it is
// weighed: of unknown variance, and of fewer independent samples than rows.
// Likelihoods are tempered by the autocorrelation time instead of whitened by
// what is left (a composite likelihood with the effective number of samples;
// Ribatet, Cooley and Davison 2012): whitening would take structured misfit for
// noise and see the less of it, the more there is.
struct EvidenceNoise {
  Eigen::VectorXd variance;  // n, (N m)^2 or N^2
  Eigen::VectorXd time;      // n, integrated autocorrelation time, rows
  Eigen::VectorXd fitted;    // n, rows that the baseline fits

  // Of white noise that tells as much, N m or N.
  Eigen::VectorXd stddev() const {
    return variance.cwiseProduct(time).cwiseSqrt();
  }
};

// The fixed point of the fit to a screen's rows and what it leaves: variances
//   v_j = E |r_j|^2 / N_j,  E |r_j|^2 = |r_j|^2 + tr(A_j C A_j'),
// with the fit's weights 1 / (v_j time_j). `stddev`: those of the rows as they
// are. All columns of the screen are fitted.
EvidenceNoise SettleNoise(GapScreen screen, Eigen::VectorXd stddev);

// 2 log of the evidence of a screen's model, all its columns fitted, with the
// times of `noise` and variances at their fixed point:
//   -[sum_j N_j / time_j log(v_j) + chi^2 + ln det(information)],
// up to what models of the same rows and times share.
double LogEvidence(GapScreen screen, const EvidenceNoise& noise);

// Of the factors by which a screen's baseline columns `which` may be scaled
// (their prior stays N(0, 1)) the one with the largest LogEvidence, the first
// of equal ones.
double LikeliestScale(const GapScreen& screen, const EvidenceNoise& noise,
                      const std::vector<int>& which,
                      const std::vector<double>& factors);

// A larger model against a smaller one.
struct LargerModel {
  double odds = 0;            // 2 log
  Eigen::VectorXd explained;  // n, variance that the smaller one leaves more
};

// The larger model says how many samples are independent, for both (tempered
// likelihoods can be compared under one temperature only); variances are each
// model's own:
//   sum_j N_j / time_j log(v0_j / v1_j) + cost0 - cost1,
// cost: of the baseline's values by their prior. `noise`: the smaller one's.
LargerModel CompareLarger(const GapScreen& smaller, const GapScreen& larger,
                          const EvidenceNoise& noise);

}  // namespace armcal
