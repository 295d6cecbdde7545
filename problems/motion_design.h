#pragma once

#include <ceres/first_order_function.h>

#include <Eigen/Core>

#include "model/signals/harmonic_basis.h"
#include "problems/excitation_criterion.h"
#include "problems/motion_information.h"
#include "problems/motion_limits.h"
#include "problems/workspace.h"

namespace armcal {

// What a motion is kept within.
struct MotionBounds {
  MotionLimits limits;
  const Workspace* workspace;  // not null
  double clearance = 0;        // m, to be kept from all of it
};

// The design of a periodic motion as a function of the numbers of its
// HarmonicBasis (size() x joints, column by column): the criterion plus
// `barrier` times LimitBarrier and Workspace::Barrier. Where a bound is broken
// or the information is singular there is no value.
class MotionDesign : public ceres::FirstOrderFunction {
 public:
  // Keeps references. `units`: HarmonicBasis::Units over one period. `weight`:
  // MotionInformation's. `x`: the model parameters that torques are taken of.
  MotionDesign(const Motion& units, const MotionBounds& bounds,
               const DesignQuantities& quantities,
               ExcitationCriterion criterion, const Eigen::VectorXd& weight,
               const Eigen::VectorXd& x, MotionInformation* information);

  void SetBarrier(double barrier) { barrier_ = barrier; }
  int NumParameters() const override;
  bool Evaluate(const double* numbers, double* cost,
                double* gradient) const override;

 private:
  const Motion& units_;
  const MotionBounds& bounds_;
  const DesignQuantities& quantities_;
  ExcitationCriterion criterion_;
  const Eigen::VectorXd& weight_;
  const Eigen::VectorXd& x_;
  MotionInformation* information_;
  double barrier_ = 0;
};

}  // namespace armcal
