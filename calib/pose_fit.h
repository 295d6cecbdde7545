#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "calib/pose_calibration.h"
#include "model/arm_geometry.h"
#include "model/pose_reader.h"
#include "problems/pose_problem.h"

namespace armcal {

double Median(std::vector<double> values);  // 0 of none

// Fits of measured poses with some of the geometry's parameters free, and what
// there is to be fitted. `rows` are indices of poses, `free` flags of the
// geometry's parameters.
class PoseFit {
 public:
  PoseFit(const Robot& robot, const PoseMeasurements& measured,
          const PoseCalibrationOptions& options);

  const ArmGeometry& geometry() const { return *geometry_; }
  const PoseNoise& noise() const { return noise_; }
  // Coordinates of a position error.
  int Width() const { return measured_.lengths.size() > 0 ? 1 : 3; }
  // Standard deviation of the prior on parameter k; 0: none.
  double PriorOf(int k) const;

  // The parameters that refinement and this kind of measurement ask for.
  std::vector<bool> Wanted(PoseCalibrationOptions::Refine refine) const;
  // Of those, the ones that the poses can tell apart; *held says why not.
  std::vector<bool> HoldUnseen(const std::vector<bool>& wanted,
                               const std::vector<int>& rows,
                               const PoseUnknowns& at,
                               std::vector<std::string>* held) const;
  // Why there are too few poses for so many unknowns; empty if there are not.
  std::string WhyTooFew(const std::vector<bool>& free,
                        const PoseUnknowns& at) const;
  // Of all unknowns, in noise units and without the loss.
  Eigen::MatrixXd Jacobian(const std::vector<int>& rows, const PoseUnknowns& at,
                           Eigen::VectorXd* residuals = nullptr) const;
  // False where the solver found no usable solution.
  bool Solve(const std::vector<bool>& free, const std::vector<int>& rows,
             PoseUnknowns* unknowns) const;
  bool SolveWithNoise(const std::vector<bool>& free,
                      const std::vector<int>& rows, PoseUnknowns* unknowns);
  void EstimateNoise(const std::vector<bool>& free, const PoseUnknowns& at);
  // Distances of every target (or pose, or wire) of `rows`, m.
  std::vector<double> Distances(const std::vector<int>& rows,
                                const PoseUnknowns& at) const;

 private:
  bool OfInstrument(int k) const;
  bool OfTool(int k) const;
  static int NumUnknowns(const std::vector<bool>& free,
                         const PoseUnknowns& at) {
    return static_cast<int>(std::count(free.begin(), free.end(), true) +
                            at.other.size());
  }

  const PoseMeasurements& measured_;
  const PoseCalibrationOptions& options_;
  std::shared_ptr<const ArmGeometry> geometry_;
  std::vector<std::string> names_, units_;
  Eigen::VectorXd nominal_;
  PoseNoise noise_;
};

}  // namespace armcal
