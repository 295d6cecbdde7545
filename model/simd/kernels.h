#pragma once

#include <string>
#include <vector>

#include "model/simd/lanes/column_pair.h"
#include "model/simd/lanes/filter_section.h"
#include "model/simd/motion/arm_constants.h"
#include "model/simd/motion/deflected_link.h"
#include "model/simd/motion/tangent_step.h"
#include "model/simd/regressor/chain_constants.h"
#include "model/simd/regressor/geometry_constants.h"

namespace armcal::simd {

// What is computed for many samples at once, `lanes` of them side by side. The
// same source is compiled for every instruction set; results of different sets
// differ by rounding, those of one set are always the same.
struct Kernels {
  const char* instruction_set;  // "baseline", "avx2", "avx512"
  int lanes;

  // sin and cos of `count` angles, rad.
  void (*sine_cosine)(const double* angle, long count, double* sine,
                      double* cosine);

  // A regressor's columns, as BatchRegressor has them: U; P and D; and those of
  // one sample, whose arithmetic is not done in lanes.
  void (*differential)(const ChainConstants& chain, const ChainMotion& motion,
                       long count, double* const* out, long stride);
  void (*momentum)(const ChainConstants& chain, const ChainMotion& motion,
                   long count, double* const* P, double* const* D, long stride);
  void (*differential_of_one)(const ChainConstants& chain,
                              const ChainMotion& motion, long sample,
                              double* const* out, long stride);
  void (*momentum_of_one)(const ChainConstants& chain,
                          const ChainMotion& motion, long sample,
                          double* const* P, double* const* D, long stride);
  // Torques of links with `inertia` (ten parameters each) to tau[joint].
  void (*inverse_dynamics)(const ChainConstants& chain, const double* inertia,
                           const ChainMotion& motion, long count,
                           double* const* tau);

  // products[c * a_columns + a]: of every column of A with every one of B, over
  // `rows`, a multiple of 8. Columns lie a stride apart.
  void (*inner_products)(const double* A, long a_stride, int a_columns,
                         const double* B, long b_stride, int b_columns,
                         long rows, double* products);

  // Makes the upper triangle R the triangular factor of itself and the rows X
  // below it (columns a stride apart), which are lost. `rows` is a multiple of
  // 8. triangular: X is an upper triangle too, followed by rows of zeros.
  void (*householder)(double* R, long r_stride, int columns, double* X,
                      long stride, long rows, bool triangular);

  // Derivatives by geometric parameters, as GeometryJacobian has them: of
  // torques; of P and D; and those of one sample.
  void (*torque_geometry)(const ChainConstants& chain,
                          const GeometryConstants& geometry,
                          const ChainMotion& motion, long count,
                          double* const* out, long stride);
  void (*momentum_geometry)(const ChainConstants& chain,
                            const GeometryConstants& geometry,
                            const ChainMotion& motion, long count,
                            double* const* P, double* const* D, long stride);
  void (*torque_geometry_of_one)(const ChainConstants& chain,
                                 const GeometryConstants& geometry,
                                 const ChainMotion& motion, long sample,
                                 double* const* out, long stride);
  void (*momentum_geometry_of_one)(const ChainConstants& chain,
                                   const GeometryConstants& geometry,
                                   const ChainMotion& motion, long sample,
                                   double* const* P, double* const* D,
                                   long stride);
  // Deflections of links along a log, dt s apart; fastest where those with a
  // gap, and those with as many substeps, are neighbours.
  void (*deflections)(const DeflectedLink* const* links, int count,
                      long samples, double dt);
  // Forward dynamics and its integration: `lanes` at once, and one by one.
  ArmKernels arms, one_arm;
  // y = tanh(x / width) of `count` numbers.
  void (*hyperbolic_tangent)(const double* x, double width, long count,
                             double* y);

  // Filters in place by two sections, forwards and then backwards, each from
  // rest at its first row. Rows hold `width` signals side by side, a multiple
  // of 8; what one signal is does not matter to the others.
  void (*filter_both_ways)(const FilterSection* sections, double* x, long rows,
                           int width);

  // As inner_products, added up over two pairs with as many columns.
  void (*inner_products_of_two)(const ColumnPair* pairs, int a_columns,
                                int b_columns, long rows, double* products);

  // medians[k] of the 2 reach + 1 numbers about x[k], for all k that have as
  // many; `reach` is 15 at most.
  void (*sliding_medians)(const double* x, long count, int reach,
                          double* medians);

  // Derivatives of (q, qd), 2 n rows, from a step's begin to its end.
  void (*advance_tangents)(const TangentStep& step, double* state);
};

// Of the instruction sets that this processor has, the least first.
const std::vector<const Kernels*>& AvailableKernels();
// Of the best of them, or of the one that the environment variable
// ARMCAL_INSTRUCTION_SET names. Throws InputError if it is none of them.
const Kernels& BestKernels();

}  // namespace armcal::simd
