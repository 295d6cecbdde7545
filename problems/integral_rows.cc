#include "problems/integral_rows.h"

#include <algorithm>
#include <cmath>

#include "model/simd/kernels.h"

namespace armcal {
namespace {

constexpr int kTogether = 256;  // samples evaluated together

// Weight (in steps) of sample k of 0..steps. The trapezoid rule has an error of
// order dt^2, Simpson's of dt^4, but the latter asks for an even number of
// steps. An odd number takes Simpson's three-eighths rule, of the same order,
// for the last three; one step is a trapezoid (Davis & Rabinowitz 1984, Methods
// of Numerical Integration).
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

}  // namespace

IntegralRows::IntegralRows(const Trajectory& trajectory,
                           const RowOptions& options,
                           const MotionFunctions& functions)
    : trajectory_(trajectory),
      functions_(functions),
      quadrature_(options.quadrature) {
  if (options.intervals.empty()) {
    ListEqualIntervals(options);
  } else {
    ListIntervals(options);
  }
  intervals_.erase(
      std::remove_if(intervals_.begin(), intervals_.end(),
                     [this](const Interval& i) { return Useless(i); }),
      intervals_.end());
}

// Given intervals whose first sample is in the core; the rest of each may reach
// beyond it, into what the trajectory has of the next block.
void IntegralRows::ListIntervals(const RowOptions& options) {
  const Trajectory& t = trajectory_;
  for (const TimeRange& interval : options.intervals) {
    const long a = std::lround((interval.begin - t.t0) / t.dt);
    const long b = std::lround((interval.end - t.t0) / t.dt);
    if (a >= t.core_begin && a < t.core_end && b > a && b < t.size()) {
      intervals_.push_back({static_cast<int>(a), static_cast<int>(b)});
    }
  }
}

// Intervals side by side that begin in the core. They begin at multiples of
// their length from the segment's beginning, wherever blocks of the log begin.
void IntegralRows::ListEqualIntervals(const RowOptions& options) {
  const Trajectory& t = trajectory_;
  if (options.interval_s > t.size() * t.dt) return;
  long steps = std::max(1L, std::lround(options.interval_s / t.dt));
  if (quadrature_ == Quadrature::kSimpson) steps += steps % 2;
  for (int a = t.core_begin; a < t.core_end; ++a) {
    if ((t.first_index + a) % steps == 0 && a + steps < t.size()) {
      intervals_.push_back({a, static_cast<int>(a + steps)});
    }
  }
}

bool IntegralRows::Useless(const Interval& interval) const {
  for (int k = interval.begin; k <= interval.end; ++k) {
    if (functions_.Useless(k)) return true;
  }
  return false;
}

double IntegralRows::time(long row) const {
  const Interval& interval = intervals_[row];
  return trajectory_.time((interval.begin + interval.end) / 2);
}

void IntegralRows::Evaluate(long begin, long count, double* const* out,
                            long stride, RowScratch* scratch) const {
  const std::vector<int> sizes = RowSizes(functions_, 1);
  scratch->P.Resize(sizes, kTogether);
  scratch->D.Resize(sizes, kTogether);
  std::vector<double*> at(sizes.size());
  for (long r = 0; r < count; ++r) {
    for (size_t i = 0; i < sizes.size(); ++i) {
      at[i] = out[i] + r;
      for (int c = 0; c < sizes[i]; ++c) at[i][c * stride] = 0;
    }
    EvaluateRow(intervals_[begin + r], at.data(), stride, scratch);
  }
}

// One row by (2.27), w_k the quadrature's weights times dt:
//   u_c = P_c(t2) - P_c(t1) - sum_k w_k D_c(t_k),   y = sum_k w_k tau(t_k).
// The torque stands in D's last column, so that one kernel sums all columns.
// Samples come in groups that stay in the cache. Weights behind the last sample
// are 0 up to the kernel's width, whatever the columns hold there.
void IntegralRows::EvaluateRow(const Interval& interval, double* const* out,
                               long stride, RowScratch* scratch) const {
  const std::vector<int> sizes = RowSizes(functions_, 1);
  const JointColumns &P = scratch->P, &D = scratch->D;
  const int steps = interval.end - interval.begin;
  double weights[kTogether];
  for (int done = 0; done <= steps; done += kTogether) {
    const int count = std::min(kTogether, steps + 1 - done);
    const int whole = (count + 7) / 8 * 8;
    for (int k = 0; k < whole; ++k) {
      weights[k] = k < count ? QuadratureWeight(quadrature_, done + k, steps) *
                                   trajectory_.dt
                             : 0;
    }
    const int first = interval.begin + done;
    functions_.Momentum(first, count, P.data(), D.data(), D.stride());
    for (int i = 0; i < static_cast<int>(sizes.size()); ++i) {
      const int last = sizes[i] - 1;
      std::copy_n(trajectory_.tau.col(i).data() + first, count,
                  D.column(i, last));
      scratch->products.resize(sizes[i]);
      simd::BestKernels().inner_products(weights, kTogether, 1, D.column(i, 0),
                                         D.stride(), sizes[i], whole,
                                         scratch->products.data());
      for (int c = 0; c < last; ++c) {
        double* u = out[i] + c * stride;
        *u -= scratch->products[c];
        if (done == 0) *u -= P.column(i, c)[0];
        if (done + count == steps + 1) *u += P.column(i, c)[count - 1];
      }
      out[i][last * stride] += scratch->products[last];
    }
  }
}

}  // namespace armcal
