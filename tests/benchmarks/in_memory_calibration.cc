#include "tests/benchmarks/in_memory_calibration.h"

#include <algorithm>
#include <cmath>

#include "calib/linear/row_reduction.h"
#include "problems/make_rows.h"

namespace armcal {
namespace {

constexpr int kCore = 20000;  // samples, TrajectoryReader's longest

// Samples of a core and of `reach` on either side.
Trajectory Stretch(const Trajectory& log, int core, int reach) {
  const int begin = std::max(0, core - reach);
  const int end = std::min(log.size(), core + kCore + reach);
  const int count = end - begin;
  Trajectory t;
  t.t0 = log.time(begin);
  t.dt = log.dt;
  t.q = log.q.middleRows(begin, count);
  t.qd = log.qd.middleRows(begin, count);
  t.qdd = log.qdd.middleRows(begin, count);
  t.tau = log.tau.middleRows(begin, count);
  t.standstill = log.standstill.segment(begin, count);
  t.first_index = begin;
  t.core_begin = core - begin;
  t.core_end = std::min(log.size(), core + kCore) - begin;
  return t;
}

}  // namespace

InMemoryCalibration::InMemoryCalibration(const ModelParameters& parameters,
                                         const RowOptions& options,
                                         const Trajectory& log) {
  BlockTriangularFactor factor(parameters, RowsPerLeaf(options));
  MotionRegressor regressor(parameters);
  RowReduction reduction(parameters);
  const int reach = static_cast<int>(std::ceil(RowReach(options) / log.dt));
  for (int core = 0; core < log.size(); core += kCore) {
    const Trajectory stretch = Stretch(log, core, reach);
    regressor.Enter(stretch);
    reduction.Add(*MakeRows(stretch, options, regressor), &factor);
  }
  noise = RightSideRms(factor);
  const ReferenceScale reference = MakeReferenceScale(
      parameters, 1, 1, 1, noise, Eigen::VectorXd::Zero(parameters.size()));
  solution = SolveReweighted(
      factor, reference, std::vector<bool>(parameters.num_joints()), &noise);
  covariance = solution.IndependentCovariance(factor, noise);
}

}  // namespace armcal
