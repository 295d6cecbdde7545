#include "problems/integral_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Weight (in steps) of sample k of 0..steps. Simpson's rule of an odd number of
// steps takes three eighths for the last three; one step is a trapezoid.
double QuadratureWeight(Quadrature rule, int k, int steps) {
  if (rule == Quadrature::kTrapezoid || steps == 1) {
    return k == 0 || k == steps ? 0.5 : 1;
  }
  const int thirds = steps - (steps % 2 == 0 ? 0 : 3);
  double weight = 0;
  if (k < thirds) weight = k == 0 ? 1.0 / 3 : k % 2 == 1 ? 4.0 / 3 : 2.0 / 3;
  if (k == thirds && thirds > 0) weight = 1.0 / 3;
  if (thirds < steps && k >= thirds) {
    weight += k == thirds || k == steps ? 3.0 / 8 : 9.0 / 8;
  }
  return weight;
}

// The first and last sample of every interval of the core.
std::vector<std::pair<int, int>> IntervalSamples(const Trajectory& t,
                                                 const RowOptions& options) {
  std::vector<std::pair<int, int>> result;
  if (!options.intervals.empty()) {
    for (const TimeRange& interval : options.intervals) {
      const long a = std::lround((interval.begin - t.t0) / t.dt);
      const long b = std::lround((interval.end - t.t0) / t.dt);
      if (a >= t.core_begin && a < t.core_end && b > a && b < t.size()) {
        result.emplace_back(a, b);
      }
    }
    return result;
  }
  if (options.interval_s > t.size() * t.dt) return result;
  long steps = std::max(1L, std::lround(options.interval_s / t.dt));
  if (options.quadrature == Quadrature::kSimpson) steps += steps % 2;
  for (int a = t.core_begin; a < t.core_end; ++a) {
    if ((t.first_index + a) % steps == 0 && a + steps < t.size()) {
      result.emplace_back(a, a + steps);
    }
  }
  return result;
}

}  // namespace

void ForEachIntegralRow(const Trajectory& trajectory, const RowOptions& options,
                        MotionRegressor* regressor, const RowSink& sink) {
  const int n = trajectory.num_joints();
  MatrixXd P, D;
  for (const auto& [begin, end] : IntervalSamples(trajectory, options)) {
    IdentificationRow row;
    row.time = trajectory.time((begin + end) / 2);
    row.U.setZero(n, regressor->parameters().size());
    row.Y.setZero(n);
    bool use = true;
    for (int k = begin; k <= end; ++k) {
      regressor->Momentum(k, &P, &D);
      const double w =
          QuadratureWeight(options.quadrature, k - begin, end - begin) *
          trajectory.dt;
      row.U -= w * D;
      row.Y += w * trajectory.tau.row(k).transpose();
      if (k == begin) row.U -= P;
      if (k == end) row.U += P;
      use = use && !regressor->Useless(k);
    }
    if (use) sink(row);
  }
}

}  // namespace armcal
