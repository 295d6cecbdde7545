#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "calib/poses/held_out_comparison.h"
#include "model/robot/arm_geometry.h"
#include "model/robot/robot.h"
#include "problems/poses/pose_problem.h"

namespace armcal {

struct PoseCalibrationOptions {
  RefineGeometry refine = RefineGeometry::kAll;
  // Tukey's gives wrong poses up, where Huber's lets each pull for ever.
  RobustLoss loss = RobustLoss::kTukey;
  // How far the arm's parameters may reasonably be from the file's: standard
  // deviations of the prior, m and rad.
  double prior_length = 0.01;
  double prior_angle = 0.02;
  int folds = 6;  // of the cross-validation
  // Poses that take no part in the fit: how they are predicted is told, and
  // decides nothing. Null: none.
  const PoseMeasurements* validation = nullptr;
};

struct GeometryEstimate {
  std::string name;
  std::string unit;
  double nominal;
  double value;
  double stddev;  // infinite where not identifiable
  double prior;   // standard deviation of the prior, 0: none
  bool identifiable;
};

// Where the things are that were measured: a reflector on the tool, an anchor,
// a point that was touched.
struct ObservedEstimate {
  std::string name;  // PoseUnknowns::OtherNames: "target1.x"
  std::string unit;
  double value;
  double stddev;  // infinite where not identifiable
};

// Poses that took no part in the fit, m rms (rad of tilts), predicted with the
// instrument where the fit found it: by the file's geometry and the estimate.
struct PoseValidation {
  int count = 0;
  double file_rms = 0;
  double rms = 0;
  double median = 0;
};

// What was estimated of the instrument beside the arm: a camera's lens, where a
// second camera is.
struct InstrumentEstimate {
  std::string name;  // "camera.fx", "camera2.x"
  std::string unit;
  double start;  // by the images alone
  double value;
  double stddev;
};

// Joint `joint` turns by `factor` times the position of joint `by` beside what
// was recorded for it: a coupling of two joints or, of one with itself, a gear
// ratio.
struct PoseCoupling {
  int joint, by;
  double factor;  // rad/rad, m/rad, rad/m or 1
  double stddev;
  // m, of all poses, both with the best geometry beside it.
  double rms_before, rms_after;
  double angle_before = 0, angle_after = 0;  // rad, where poses were measured
};

// What is left beside the uncertainty that the file states for the instrument.
struct PoseMisfit {
  // Root mean square of coordinates, inliers alone, in the instrument's
  // standard deviations; NaN where the file states none.
  double instrument_ratio = std::numeric_limits<double>::quiet_NaN();
  double instrument_u95 = 0;  // m, its median
  // Of successive poses in the order of the file, inliers alone: 1 if each
  // repeats the one before; and its standard deviation if none did.
  double order_correlation = 0;
  double order_stddev = 1;
};

// A calibration of the geometry from measured poses.
struct PoseCalibration {
  bool solved = false;
  std::string reason;
  std::vector<GeometryEstimate> parameters;  // estimated ones
  std::vector<ObservedEstimate> observed;
  std::vector<InstrumentEstimate> instrument;
  // Sentences: what is held because the poses cannot tell it.
  std::vector<std::string> held;
  int count = 0;                         // poses
  std::string unit = "m";                // of deviations below; of tilts "rad"
  bool refined = false;                  // the arm's own geometry too
  RobustLoss loss = RobustLoss::kTukey;  // by which it was fitted
  Eigen::VectorXd travel;                // per joint, all poses, rad or m
  double extent = 0;  // m, rms of measured positions about their mean
  PoseNoise noise;
  // m, per pose and target: with only the frame fitted, with the estimate.
  std::vector<double> before, after;
  double before_rms = 0;  // m, only the frame fitted
  double rms = 0;         // m, all poses
  double inlier_rms = 0;
  double median = 0;
  double max = 0;
  double held_out_rms = 0;  // cross-validated
  double held_out_median = 0;
  // The file's geometry, with the frame and what was observed fitted to the
  // others in the same way; of a refined geometry alone.
  double file_held_out_rms = 0;
  // By how much the mean square of poses left out is larger with the refined
  // geometry than with the file's, m^2.
  HeldOutExcess held_out_excess;
  // Root mean squares of these, with the refined and with the file's, m.
  double compared_rms = 0, file_compared_rms = 0;
  std::optional<PoseValidation> validation;
  std::vector<int> outliers;  // poses that Tukey's loss gives up
  // Per joint, the share of its motion (of its sum of squares about the mean)
  // that is in poses which are no outliers.
  Eigen::VectorXd inlier_motion;
  PoseMisfit misfit;
  std::optional<PoseCoupling> coupling;
  Robot robot;  // with the refined geometry
};

}  // namespace armcal
