#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "calib/poses/calibration.h"
#include "calib/poses/diagnosis/held_out.h"
#include "calib/poses/diagnosis/model.h"
#include "calib/poses/misfit.h"

namespace armcal {

struct PoseAmount {
  std::string name, unit;
  double value;
  double half_width;  // of the 95 % interval; infinite where it is not told
  // What others told of it, which `value` has in it, and the poses alone.
  Told told = {}, by_poses = {};
  // By how many standard deviations of their difference these two disagree.
  double Apart() const {
    return std::abs(by_poses.value - told.value) /
           std::hypot(by_poses.stddev, told.stddev);
  }
};

// Of amounts that are a vector's components, of a sine and a cosine say: its
// length |x|, with the interval of x'C x / |x|^2.
PoseAmount LengthOf(const std::string& name,
                    const std::vector<PoseAmount>& components,
                    const Eigen::MatrixXd& ci95);

// Another cause that the poses cannot tell from an effect.
struct PoseEquivalent {
  PlacedPoseEffect placed;
  std::string name;
  double probability;
  // Joint positions within the range of the poses at which the two models
  // differ most, and by how much, m; empty: they are told apart by the order.
  Eigen::VectorXd told_apart_at;
  double differ = 0;
};

// An effect beside which that there is none is at least as likely: nothing is
// claimed of it.
struct UnlikelyPoseEffect {
  std::string name;
  double probability = 0;
  double none = 0;
};

struct PoseFinding {
  PlacedPoseEffect placed;
  std::string name;
  double probability = 0;  // beside its rivals and that there is none
  double none = 0;         // that there is none
  std::vector<PoseAmount> amounts;
  Eigen::MatrixXd ci95;  // of the amounts: covariance times the quantile^2
  // First and last pose (of the file's, from 0) that it may begin, and end at.
  int begin[2] = {-1, -1}, end[2] = {-1, -1};
  double displacement_rms = 0, displacement_max = 0;  // m, of the targets
  HeldOutGain interleaved, contiguous;  // of the model beside one without it
  std::vector<PoseEquivalent> equivalents;
};

// Whether it is a joint that turns by 1 - 2 times what it says, as far as its
// interval tells.
bool CountsTheOtherWay(const PoseFinding& finding);

// Root mean squares of distances, m.
struct PoseGap {
  double file = 0;      // with the instrument's frame fitted alone
  double geometry = 0;  // with the geometry, no effects
  double after = 0;     // with the effects
  double held_out_geometry = 0, held_out_after = 0;    // every sixth pose
  double stretches_geometry = 0, stretches_after = 0;  // six stretches
};

enum class PoseVerdict {
  kNoiseFloor,       // nothing found, and nothing left that is no noise
  kExplained,        // effects found, and only noise is left
  kPartlyExplained,  // effects found, and more is left
  kUnknown,          // nothing found that explains what is left
  kNotTestable,
};
const char* PoseVerdictName(PoseVerdict verdict);

// Whether an effect is likelier than all else together; a finding that is not
// is one of a few causes that the poses cannot tell apart.
inline bool IsNamed(const PoseFinding& finding) {
  return finding.probability >= .5;
}

struct PoseDiagnosis {
  PoseVerdict verdict = PoseVerdict::kNotTestable;
  std::string reason;  // of kNotTestable
  std::vector<PoseFinding> findings;
  // The likeliest effects that held-out poses do not confirm.
  std::string unconfirmed;
  std::vector<UnlikelyPoseEffect> unlikely;
  PoseGap gap;
  PoseMisfit misfit;  // what the effects leave
  // Residuals of the geometry without effects, as model.estimate.linear.r.
  Eigen::VectorXd left_by_geometry;
  double coordinate_rms = 0;      // of it, m
  std::vector<double> distances;  // of each target and pose, m
  std::vector<int> outliers;      // poses (from 0) that fit no better than a
                                  // tenth of the others' weight
  double design_effect = 1;
  double nu = std::numeric_limits<double>::infinity();
  int unknowns = 0;
  PoseModel model;  // the geometry with the effects found
};

}  // namespace armcal
