#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "calib/diagnose/judge/removed_share.h"
#include "calib/diagnose/judge/where.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// What is left given the effects that were found.
struct Unexplained {
  std::string joint;
  std::string organised_by;
  double share = 0;  // of the refitted model's excess over the noise
};

struct JointGap {
  std::string name;
  std::string unit;
  // rms of the held-out torque residual, N m or N; NaN where none was held out.
  double nominal_rms = NAN, refit_rms = NAN, after_rms = NAN;
  // rms of what it may be by noise, and by how little is known of the model in
  // such motion (at reversals of friction, beyond a reference's speeds), N m.
  double floor_rms = 0;
  double torque_rms = 0;  // of the recorded torque there, N m or N
  // By which factor what the model leaves may be larger in this motion than in
  // the reference's, rms (MotionRange); 1 without one.
  double beyond_reference = 1;
  Organisation organised;  // of the refitted model's residual
  double unexplained = 0;  // chi^2 beyond the noise's after the effects
};

// Of joint j, without what is said of it in N m (SetRms). `torque`: held-out
// figures of the fit.
JointGap JointGapOf(const Robot& robot, const GapFit& fit,
                    const GapFigures& torque, int j);
void SetBeyondReference(const GapFit& fit, std::vector<JointGap>* joints);
// HeldOut::RmsOf as the joints' figures; noise and recorded torque stay those
// of the fitted logs where nothing is held out.
void SetRms(const Eigen::MatrixXd& rms, std::vector<JointGap>* joints);

// What no effect explains, in sample: its share of what a refit leaves beyond
// the noise, and the joint that holds most of it.
Unexplained SumUnexplained(const GapFit& fit,
                           const std::vector<JointGap>& joints);

}  // namespace armcal
