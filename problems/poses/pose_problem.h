#pragma once

#include <ceres/problem.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "model/log_files/pose_reader.h"
#include "model/robot/arm_geometry.h"
#include "problems/robust_loss.h"

namespace armcal {

// What a loss makes of residuals in noise units, of which `block` at a time
// share it: psi = rho'(s) r, which pulls at the estimate, and the mean of its
// derivative, by which the information J'J counts.
struct LossScores {
  Eigen::VectorXd psi;
  double slope;
};
LossScores ScoresOf(const Eigen::VectorXd& residuals, int block,
                    RobustLoss loss);

// The variance of an M-estimate over that of (J'J)^-1 (Huber 1981, 7.6, without
// the factor K, which tends to 1 for p / N to 0):
//   (sum psi^2 / (N - p)) / (mean psi')^2
// for N residuals in noise units, in blocks of `block` that share a loss, and p
// unknowns. Right also where the noise was only guessed.
double VarianceFactor(const Eigen::VectorXd& residuals, int block,
                      RobustLoss loss, int num_unknowns);

// Standard deviations of the errors; where the instrument's own are known
// (PoseMeasurements::covariance), of what the arm adds to these.
struct PoseNoise {
  // m, of each coordinate or of a wire's length; rad of an inclinometer.
  double position = 1e-3;
  double rotation = 1e-3;  // rad, of each component
};
// X_WM of a whole pose.
Eigen::Isometry3d MeasuredPose(const PoseMeasurements& measured, int pose);
// Coordinates of a position's error: 3, or 1 of a wire or a plane; of an
// inclinometer 2, in rad wherever others are in m.
int CoordinatesOf(const PoseMeasurements& measured);
// How an instrument's unknowns move it, 6 x unknowns.
Eigen::MatrixXd InstrumentMoves(const PoseMeasurements& measured, int pose);
// What makes errors of a pose's position and rotation independent, of variance
// 1 each.
Matrix6d PoseWhitening(const PoseMeasurements& measured, const PoseNoise& noise,
                       int pose);

// The unknowns of a geometric calibration, in two parameter blocks: the
// geometry (ArmGeometry::Values) and what else the measurement needs: the
// targets on the tool or the points that it touches (3 each, m), the planes
// that it touches (3 each, plane_residual.h), the wire's anchor and length
// offset (4), or an instrument's own (InstrumentUnknowns).
struct PoseUnknowns {
  Eigen::VectorXd geometry;
  Eigen::VectorXd other;

  static int NumOther(const PoseMeasurements& measured);
  // "target2.y", "point1.x", "plane1.a", "wire.x", "wire.offset",
  // "instrument1".
  static std::vector<std::string> OtherNames(const PoseMeasurements& measured);
  // Standard deviations of their priors, about 0; 0: none.
  static Eigen::VectorXd OtherPriors(const PoseMeasurements& measured);
};

// Which of the geometry's parameters `refine` and these measurements (null:
// none, torques alone) leave free.
std::vector<bool> FreeGeometry(const ArmGeometry& geometry,
                               RefineGeometry refine,
                               const PoseMeasurements* measured);

// Adds the residuals of poses `rows` to `problem`, whose parameter blocks are
// those of `unknowns`.
void AddPoseResiduals(const std::shared_ptr<const ArmGeometry>& geometry,
                      const PoseMeasurements& measured,
                      const std::vector<int>& rows, const PoseNoise& noise,
                      RobustLoss loss, PoseUnknowns* unknowns,
                      ceres::Problem* problem);

// Deviations predicted - measured of every pose in m: 3 per target, 3 of a
// pose's position, 1, or the 2 of an inclinometer (rad); and rotation vectors
// (3, rad) of poses.
Eigen::MatrixXd PositionErrors(const ArmGeometry& geometry,
                               const PoseMeasurements& measured,
                               const PoseUnknowns& unknowns);
Eigen::MatrixXd RotationErrors(const ArmGeometry& geometry,
                               const PoseMeasurements& measured,
                               const PoseUnknowns& unknowns);

}  // namespace armcal
