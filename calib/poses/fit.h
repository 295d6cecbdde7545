#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "calib/poses/calibration.h"
#include "model/log_files/pose_reader.h"
#include "model/robot/arm_geometry.h"
#include "problems/poses/pose_problem.h"

namespace armcal {

// Standard deviation of the robot file's prior on parameter k of the geometry,
// given those of its lengths (m) and angles (rad); 0: none, of base and tool.
double GeometryPrior(const ArmGeometry& geometry, int k, double length,
                     double angle);

// Throws InputError where the robot has several tips: which one a pose is of
// would be open.
void RequireOneTool(const Robot& robot);

// Fits of measured poses with some of the geometry's parameters free, and what
// there is to be fitted. `rows` are indices of poses, `free` flags of the
// geometry's parameters.
class PoseFit {
 public:
  PoseFit(const Robot& robot, const PoseMeasurements& measured,
          const PoseCalibrationOptions& options);

  const ArmGeometry& geometry() const { return *geometry_; }
  const PoseNoise& noise() const { return noise_; }
  void set_noise(const PoseNoise& noise) { noise_ = noise; }
  // With the instrument's own, the poses' median.
  PoseNoise TypicalNoise() const;
  std::vector<int> AllRows() const;
  // Of the estimate's covariance over (J'J)^-1 (pose_problem.h).
  double VarianceFactor(const Eigen::VectorXd& residuals,
                        int num_unknowns) const {
    return armcal::VarianceFactor(residuals, Coordinates(), options_.loss,
                                  num_unknowns);
  }
  LossScores Scores(const Eigen::VectorXd& residuals) const {
    return ScoresOf(residuals, Coordinates(), options_.loss);
  }
  // Coordinates of a position error.
  int Width() const { return CoordinatesOf(measured_); }
  // Coordinates of a residual that share a loss.
  int Coordinates() const { return measured_.poses.size() > 0 ? 6 : Width(); }
  // Of all targets of a pose.
  int EquationsPerPose() const;
  // That the poses have to tell: a prior is as good as equations.
  int NumUnknowns(const std::vector<bool>& free) const {
    const Eigen::VectorXd priors = PoseUnknowns::OtherPriors(measured_);
    return static_cast<int>(std::count(free.begin(), free.end(), true) +
                            (priors.array() == 0).count());
  }
  // Standard deviation of the prior on parameter k; 0: none.
  double PriorOf(int k) const;

  // The parameters that refinement and this kind of measurement ask for.
  std::vector<bool> Wanted(RefineGeometry refine) const {
    return FreeGeometry(*geometry_, refine, &measured_);
  }
  RefineGeometry refine() const { return options_.refine; }  // asked for
  const PoseMeasurements& measured() const { return measured_; }
  // Why there are too few poses for so many unknowns; empty if there are not.
  std::string WhyTooFew(const std::vector<bool>& free) const;
  // Of all unknowns, in noise units and without the loss.
  Eigen::MatrixXd Jacobian(const std::vector<int>& rows, const PoseUnknowns& at,
                           Eigen::VectorXd* residuals = nullptr) const;
  // With rows of its own for the priors of what is none of the geometry.
  Eigen::MatrixXd WithOtherPriors(const Eigen::MatrixXd& jacobian) const;
  // The same residuals, pose by pose: of position (or the wire), of rotation.
  Eigen::VectorXd Residuals(const std::vector<int>& rows,
                            const PoseUnknowns& at) const;
  // Adds the residuals of poses `rows`, whose blocks are those of `unknowns`.
  void AddResiduals(const std::vector<int>& rows, PoseUnknowns* unknowns,
                    ceres::Problem* problem) const {
    AddPoseResiduals(geometry_, measured_, rows, noise_, options_.loss,
                     unknowns, problem);
  }
  // False where the solver found no usable solution.
  // `tolerance`: where it is at rest, relative to the cost (SolveDense).
  bool Solve(const std::vector<bool>& free, const std::vector<int>& rows,
             RobustLoss loss, PoseUnknowns* unknowns,
             double tolerance = 1e-12) const;
  // With the noise re-estimated; a loss that gives poses up starts where
  // Huber's ends.
  bool SolveWithNoise(const std::vector<bool>& free,
                      const std::vector<int>& rows, PoseUnknowns* unknowns);
  void EstimateNoise(const std::vector<bool>& free, const PoseUnknowns& at);
  // Distances of every target (or pose, or wire) of `rows`, m.
  std::vector<double> Distances(const std::vector<int>& rows,
                                const PoseUnknowns& at) const;

 private:
  const PoseMeasurements& measured_;
  const PoseCalibrationOptions& options_;
  std::shared_ptr<const ArmGeometry> geometry_;
  Eigen::VectorXd nominal_;
  PoseNoise noise_;
};

}  // namespace armcal
