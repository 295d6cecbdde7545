#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "calib/poses/calibration.h"
#include "calib/poses/fit.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"
#include "problems/poses/pose_problem.h"

namespace armcal {

// The joint stands where it was recorded plus an amount times `signal`, which
// has a value for each pose.
struct JointCorrection {
  int joint;
  Eigen::VectorXd signal;
  double prior = 0;  // standard deviation of the amount, 0: none
};

// Where such a fit stands.
struct JointTermsState {
  PoseUnknowns unknowns;
  Eigen::VectorXd amounts;  // of the terms
};

// Plain least squares of measured poses: the instrument's frame, the arm's
// geometry beside its prior, and the amounts of joint terms. No loss gives a
// pose up here, since one that a robust fit calls wrong may be the only one
// that shows a term.
class JointTermsFit {
 public:
  JointTermsFit(const Robot& robot, const PoseMeasurements& measured,
                const PoseCalibrationOptions& options,
                std::vector<JointCorrection> terms);
  JointTermsFit(const JointTermsFit&) = delete;  // fit_ refers to corrected_
  JointTermsFit& operator=(const JointTermsFit&) = delete;

  // The frame by alignment, the geometry as in the file, no amounts.
  JointTermsState Start();
  // Lets those of the geometry's parameters vary that `what` asks for and all
  // poses tell apart at `at`, where targets should be about where they are: on
  // the tool's origin they do not show how the last link is turned.
  void Free(RefineGeometry what, const JointTermsState& at);
  // The same parameters as another fit of the same poses.
  void FreeAlike(const JointTermsFit& other) { free_ = other.free_; }
  // Fits `rows` from *state on, at the noise that is set. False where no step
  // could be computed.
  bool Solve(const std::vector<int>& rows, JointTermsState* state);
  // The same, with the noise set to what was left before, in turn: what a model
  // does not explain then counts as noise beside the geometry's prior.
  bool SolveWithNoise(const std::vector<int>& rows, JointTermsState* state);
  void set_noise(const PoseNoise& noise) { fit_.set_noise(noise); }
  const PoseNoise& noise() const { return fit_.noise(); }

  // How much chi^2 would fall, to first order, by one more term for each joint
  // (rows) and each of `signals` (columns, a value for each pose).
  Eigen::MatrixXd Gains(const std::vector<int>& rows,
                        const Eigen::MatrixXd& signals,
                        const JointTermsState& at);
  // Standard deviation of an amount for errors that are independent between
  // poses and alike within one.
  double Stddev(int term, const std::vector<int>& rows,
                const JointTermsState& at);
  // Mean squares of what is left: of positions (m^2, a coordinate) and, of
  // measured poses, of rotations (rad^2).
  std::vector<double> MeanSquares(const std::vector<int>& rows,
                                  const JointTermsState& at);
  // Of positions or wires, m.
  double RmsDistance(const std::vector<int>& rows, const JointTermsState& at);
  // Coordinates less unknowns; not above 0 where there are too few.
  int SpareEquations() const;

 private:
  struct Equations {
    Eigen::MatrixXd A;  // J'J and the prior
    Eigen::VectorXd b;  // -J'r and the prior's
  };

  void Correct(const Eigen::VectorXd& amounts);
  Eigen::VectorXd Residuals(const std::vector<int>& rows,
                            const JointTermsState& at);
  double Cost(const std::vector<int>& rows, const JointTermsState& at);
  // d(residuals) / d(position of the joint), of the pose's own.
  Eigen::VectorXd JointColumn(int joint, const std::vector<int>& rows,
                              const JointTermsState& at,
                              const Eigen::VectorXd& residuals);
  // Of the free unknowns, terms last.
  Eigen::MatrixXd Jacobian(const std::vector<int>& rows,
                           const JointTermsState& at, Eigen::VectorXd* r);
  // Of the Jacobian J and the residuals r at `at`.
  Equations Normal(const Eigen::MatrixXd& J, const Eigen::VectorXd& r,
                   const JointTermsState& at) const;
  JointTermsState Moved(const JointTermsState& at,
                        const Eigen::VectorXd& step) const;
  std::pair<double, double> PriorOf(int unknown,
                                    const JointTermsState& at) const;

  const PoseMeasurements& measured_;
  PoseMeasurements corrected_;
  PoseFit fit_;
  std::vector<JointCorrection> terms_;
  std::vector<int> free_;  // columns of the geometry's and other unknowns
  Eigen::VectorXd nominal_;
};

}  // namespace armcal
