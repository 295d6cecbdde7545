#include "model/dynamics/batch_regressor.h"

#include <glog/logging.h>

#include <algorithm>

#include "model/dynamics/regressor_plan.h"

namespace armcal {
namespace {

// to[s] = factor * from[s]; a null `from` is all ones.
void FillTerm(const double* from, double factor, long count, double* to) {
  if (from == nullptr || factor == 0) {
    std::fill_n(to, count, factor);
  } else {
    for (long s = 0; s < count; ++s) to[s] = factor * from[s];
  }
}

// What -D of the term's column multiplies; of the armature, which has none, P.
const double* TermColumn(const RegressorPlan::Term& term,
                         const MotionColumns& motion,
                         const std::vector<const double*>& of_armature) {
  const int j = term.column.joint;
  switch (term.column.term) {
    case JointTerm::kViscous:
      return motion.qd[j];
    case JointTerm::kCoulomb:
      return motion.coulomb[term.coulomb];
    case JointTerm::kOffset:
      return nullptr;
    case JointTerm::kArmature:
      break;
  }
  return of_armature[j];
}

}  // namespace

BatchRegressor::BatchRegressor(const ModelParameters& parameters,
                               const simd::Kernels& kernels)
    : plan_(std::make_shared<RegressorPlan>(
          parameters.chain(), parameters.unknown_lengths(),
          parameters.MakeRegressor().columns(), RegressorPlan::Places::kRanks)),
      kernels_(&kernels) {}

BatchRegressor::BatchRegressor(const Robot& robot, const simd::Kernels& kernels)
    : plan_(std::make_shared<RegressorPlan>(robot,
                                            RegressorPlan::Places::kRanks)),
      kernels_(&kernels) {}

BatchRegressor::BatchRegressor(const Robot& robot,
                               const std::vector<int>& columns,
                               const simd::Kernels& kernels)
    : plan_(std::make_shared<RegressorPlan>(robot, columns)),
      kernels_(&kernels) {}

// Columns of links that a joint does not move, which no path writes.
void BatchRegressor::ClearOthers(long count, double* const* out,
                                 long stride) const {
  if (plan_->paths().size() == 1) return;
  for (int i = 0; i < num_joints(); ++i) {
    for (int c = 0; c < row_size(i); ++c) {
      std::fill_n(out[i] + c * stride, count, 0.);
    }
  }
}

int BatchRegressor::num_joints() const { return plan_->num_joints(); }
int BatchRegressor::row_size(int i) const { return plan_->row_size(i); }

void BatchRegressor::Differential(const MotionColumns& motion, long count,
                                  double* const* out, long stride) const {
  CHECK_EQ(motion.qdd.size(), num_joints());
  ClearOthers(count, out, stride);
  plan_->ForEachPath(
      {motion.q.data(), motion.qd.data(), motion.qdd.data()}, out, nullptr,
      [&](auto& chain, auto& of_path, auto* rows, auto*) {
        kernels_->differential(chain, of_path, count, rows, stride);
      });
  for (const RegressorPlan::Term& term : plan_->terms()) {
    FillTerm(TermColumn(term, motion, motion.qdd), 1, count,
             out[term.column.joint] + term.place * stride);
  }
}

void BatchRegressor::Momentum(const MotionColumns& motion, long count,
                              double* const* P, double* const* D,
                              long stride) const {
  ClearOthers(count, P, stride);
  ClearOthers(count, D, stride);
  plan_->ForEachPath(
      {motion.q.data(), motion.qd.data(), nullptr}, P, D,
      [&](auto& chain, auto& of_path, auto* rows, auto* more_rows) {
        kernels_->momentum(chain, of_path, count, rows, more_rows, stride);
      });
  for (const RegressorPlan::Term& term : plan_->terms()) {
    const int j = term.column.joint;
    const bool armature = term.column.term == JointTerm::kArmature;
    const double* column = TermColumn(term, motion, motion.qd);
    FillTerm(column, armature ? 1 : 0, count, P[j] + term.place * stride);
    FillTerm(column, armature ? 0 : -1, count, D[j] + term.place * stride);
  }
}

}  // namespace armcal
