#include "calib/diagnose/select/reference_scatter.h"

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>

#include "calib/diagnose/candidates/refinement.h"
#include "calib/diagnose/data/thresholds.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kFewestLogs = 3;

// Of one log.
struct Products {
  double of_effect = 0;  // c' c
  double by_left = 0;    // c' r
};

}  // namespace

bool ReferenceScatter::IsBeyond(double quantile) const {
  if (logs < kFewestLogs) return true;
  const boost::math::students_t t(freedom);
  // A further log differs from the mean of these by more than they do.
  const double usual = stddev * std::sqrt(1 + 1. / logs);
  return usual * boost::math::quantile(t, (1 + quantile) / 2) < 1;
}

// A regression of each log's residual on the effect's torque c alone gives what
// that log shows of it, b_l = c' r / c' c, in units of the effect; 0 where the
// log has none of it. Their variance is how far logs of the same robot differ:
// an effect of that size is the scatter from log to log, and no change. The
// model, which they share, has taken up their mean only as far as its prior let
// it (that of links' masses holds much of a payload), so that it is taken out.
ReferenceScatter ScatterBetweenLogs(const GapBaseline& baseline,
                                    const MotionScale& scale,
                                    const GapCandidate& effect,
                                    const VectorXd& x, GapData* reference) {
  const GapRows& rows = reference->rows();
  const JointRows torque =
      WhitenEach(rows, EffectTorque(baseline, scale, {effect}, reference));
  const MatrixXd left = reference->ResidualWith(x);
  std::map<int, Products> logs;
  for (int j = 0; j < rows.num_joints(); ++j) {
    if (torque[j].size() == 0) continue;
    const VectorXd r = rows.Whiten(j, left.col(j));
    const auto places = rows.PlacesOfRows(j);
    for (size_t k = 0; k < places.size(); ++k) {
      Products& of = logs[rows.segments()[places[k].segment].log];
      of.of_effect += torque[j][k] * torque[j][k];
      of.by_left += torque[j][k] * r[k];
    }
  }
  std::vector<double> shown;
  double variances = 0;
  for (const auto& [log, of] : logs) {
    if (!(of.of_effect > 0)) continue;
    shown.push_back(of.by_left / of.of_effect);
    variances += 1 / of.of_effect;
  }
  ReferenceScatter scatter;
  scatter.logs = static_cast<int>(shown.size());
  if (scatter.logs < 2) return scatter;
  const Eigen::Map<const VectorXd> b(shown.data(), scatter.logs);
  scatter.freedom = scatter.logs - 1;
  scatter.stddev =
      (b.array() - b.mean()).matrix().norm() / std::sqrt(scatter.freedom);
  scatter.expected = std::sqrt(variances / scatter.logs);
  return scatter;
}

// With ratios F = stddev^2 / expected^2 of d degrees each, the pooled one is
//   sum d F / sum d,
// and a joint's scatter that times its own expected one.
ReferenceScatter PooledScatter(const ReferenceScatter& own,
                               const std::vector<ReferenceScatter>& others) {
  const auto ratio = [](const ReferenceScatter& one) {
    return std::pow(one.stddev / one.expected, 2);
  };
  if (own.freedom < 1) return own;
  double sum = 0;
  int freedom = 0;
  for (const ReferenceScatter& other : others) {
    if (other.freedom < 1) continue;
    sum += other.freedom * ratio(other);
    freedom += other.freedom;
  }
  if (freedom == 0 || !(sum > 0)) return own;
  const boost::math::fisher_f chance(own.freedom, freedom);
  const double most =
      sum / freedom * boost::math::quantile(chance, Limits().credible);
  if (ratio(own) > most) return own;
  ReferenceScatter pooled = own;
  pooled.freedom += freedom;
  pooled.stddev = own.expected *
                  std::sqrt((sum + own.freedom * ratio(own)) / pooled.freedom);
  return pooled;
}

}  // namespace armcal
