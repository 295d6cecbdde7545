#pragma once

#include <memory>
#include <vector>

#include "model/dynamics/model_parameters.h"
#include "model/dynamics/motion_columns.h"
#include "model/robot/robot.h"
#include "model/simd/kernels.h"

namespace armcal {

class RegressorPlan;

// Regressors of many samples at once. The columns of joint i's equation, and no
// others, are written: those that can be nonzero in it, in ascending order;
// column c of sample s is out[i][c * stride + s], ready to be a column-major
// matrix of one row per sample; fastest where columns begin at borders of cache
// lines (64 bytes). Samples are independent: results are the same bits for any
// cutting of them into batches. May be used by many threads.
class BatchRegressor {
 public:
  // Of the model parameters: joint i's columns are parameters.row_columns(i).
  explicit BatchRegressor(const ModelParameters& parameters,
                          const simd::Kernels& kernels = simd::BestKernels());
  // Of the links' inertial parameters, ten each (LinkRegressor): joint i's
  // columns are those of links i to n, 10 i to 10 n - 1, which are 0 of links
  // on other branches. Motion needs no Coulomb states.
  explicit BatchRegressor(const Robot& robot,
                          const simd::Kernels& kernels = simd::BestKernels());

  // Of `columns` of these, ascending, such as BaseInertials has them.
  BatchRegressor(const Robot& robot, const std::vector<int>& columns,
                 const simd::Kernels& kernels = simd::BestKernels());

  int num_joints() const;
  // The number of columns of joint i's equation.
  int row_size(int i) const;

  // U with tau = U X, (2.20); out[i] of joint i, stride >= count.
  void Differential(const MotionColumns& motion, long count, double* const* out,
                    long stride) const;
  // P and D with tau = (d/dt P - D) X; no accelerations are read.
  void Momentum(const MotionColumns& motion, long count, double* const* P,
                double* const* D, long stride) const;

 private:
  void ClearOthers(long count, double* const* out, long stride) const;

  std::shared_ptr<const RegressorPlan> plan_;
  const simd::Kernels* kernels_;
};

}  // namespace armcal
