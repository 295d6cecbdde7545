#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/poses/diagnosis/displaced_pose.h"
#include "calib/poses/effects/effect.h"
#include "calib/poses/fit.h"
#include "model/log_files/pose_reader.h"
#include "problems/poses/pose_problem.h"

namespace armcal {

// Where a fit of geometry and effects stands.
struct PoseState {
  PoseUnknowns unknowns;    // the instrument's frame, the arm, the target
  Eigen::VectorXd amounts;  // of the terms
};

// Residuals r = predicted - measured of all poses, `width()` rows a pose:
// positions or lengths in m and, of whole poses, rotations (rad) times
// `rotation_length`, the ratio of the two errors, and their derivatives.
struct LinearPoses {
  Eigen::VectorXd r;
  Eigen::MatrixXd geometry;  // by the free geometry and other unknowns
  Eigen::MatrixXd movers;    // by what terms can move, a column each
};

class PoseEquations {
 public:
  PoseEquations(const PoseFit& fit, const PoseMeasurements& measured);
  // The same of other poses of the same kind.
  PoseEquations Of(const PoseMeasurements& other) const;

  int poses() const { return measured_.size(); }
  int width() const { return width_; }
  double rotation_length() const { return rotation_length_; }
  void set_rotation_length(double length) { rotation_length_ = length; }
  // Which unknowns vary: of the geometry, and always what else there is.
  void SetFree(const std::vector<bool>& geometry);
  int num_free() const { return static_cast<int>(free_.size()); }

  Eigen::VectorXd Residuals(const std::vector<PoseTerm>& terms,
                            const PoseState& at) const;
  // Movers that no term has are 0, unless all are asked for.
  LinearPoses Linearise(const std::vector<PoseTerm>& terms, const PoseState& at,
                        bool all_movers) const;
  // d r / d amount of a term.
  Eigen::MatrixXd Columns(const LinearPoses& linear,
                          const std::vector<PoseTerm>& terms) const;
  // 1 / variance of the prior of the free unknowns, 0: none, and how far they
  // are from where it has them.
  Eigen::VectorXd Precision() const;
  Eigen::VectorXd FromFile(const PoseState& at) const;
  // Free unknowns and amounts by `step`.
  PoseState Moved(const PoseState& at, const Eigen::VectorXd& step) const;
  // Joint positions with what the terms add, poses x joints.
  Eigen::MatrixXd Standing(const std::vector<PoseTerm>& terms,
                           const Eigen::VectorXd& amounts) const;
  // By how much each joint's zero is off the file's, rad; of one that slides 0.
  Eigen::VectorXd Zeros(const PoseState& at) const;

 private:
  DisplacedPose Displace(int pose, const std::vector<PoseTerm>& terms,
                         const PoseState& at, bool with_twists) const;
  void Residual(int pose, const DisplacedPose& d, const PoseState& at,
                Eigen::Ref<Eigen::VectorXd> r) const;
  // Derivatives of a pose's residuals by a velocity of its points and an
  // angular one.
  void Project(const DisplacedPose& d, const PoseState& at,
               const Eigen::Matrix3Xd& velocity, const Eigen::Vector3d& turning,
               Eigen::Ref<Eigen::VectorXd> column) const;
  // By the instrument's unknowns.
  Eigen::MatrixXd InstrumentColumns(int pose) const;
  void GeometryColumns(int pose, const DisplacedPose& d, const PoseState& at,
                       Eigen::Ref<Eigen::MatrixXd> J) const;
  void MoverColumns(const DisplacedPose& d, const PoseState& at,
                    const std::vector<bool>& wanted,
                    Eigen::Ref<Eigen::MatrixXd> J) const;
  int Mover(const PoseTerm& term) const {
    return movers_.Index(term.acts, term.index);
  }

  const PoseFit& fit_;
  int width_;
  const PoseMeasurements& measured_;
  PoseMovers movers_;
  double rotation_length_ = 1;
  std::vector<int> free_;
  Eigen::VectorXd file_;    // geometry as in the file
  Eigen::Vector3d middle_;  // of what was measured, instrument's frame
};

}  // namespace armcal
