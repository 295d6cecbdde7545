#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "calib/watch/watcher.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Singular values below this share of the largest show nothing of the
// parameters, in units of their standard deviations.
constexpr double kShown = 1e-9;

}  // namespace

std::vector<WatchedValue> Watcher::ValuesOf(
    size_t hypothesis, const ChangeEvidence& evidence) const {
  const WatchHypothesis& change = hypotheses_[hypothesis];
  std::vector<WatchedValue> values;
  for (size_t k = 0; k < change.names.size(); ++k) {
    // Of a payload, mass and moments; its inertia shows little.
    if (change.kind == WatchHypothesis::Kind::kPayload && k > 3) break;
    values.push_back({change.names[k], change.units[k], evidence.theta[k],
                      std::sqrt(evidence.covariance(k, k))});
  }
  return values;
}

WatchState Watcher::State() const {
  WatchState state;
  state.time = last_;
  state.learning = learning();
  state.contact = contact_;
  state.residual = residual_;
  state.limit = limit_;
  for (const Lasting& lasting : lasting_) {
    const WatchHypothesis& change = hypotheses_[lasting.hypothesis];
    const ChangeTest test(lasting.since, lasting.before, lasting.root);
    for (WatchedValue value : ValuesOf(lasting.hypothesis, test.Of(change))) {
      value.name =
          (change.joint < 0 ? std::string("payload")
                            : model_.robot.links[change.joint].joint.name) +
          "." + value.name;
      state.changes.push_back(value);
    }
  }
  return state;
}

std::vector<WatchedValue> Watcher::WholeLogEstimate() const {
  const Eigen::Index p = model_.size();
  const MatrixXd triangle =
      whole_log_.Triangle().triangularView<Eigen::Upper>();
  const MatrixXd R = triangle.topLeftCorner(p, p);
  VectorXd unit = R.colwise().norm();
  for (double& value : unit) value = value > 0 ? 1 / value : 1;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factor;
  factor.setThreshold(kShown);
  factor.compute(R * unit.asDiagonal());
  const VectorXd change =
      unit.cwiseProduct(factor.solve(triangle.col(p).head(p)));
  const MatrixXd inverse = unit.asDiagonal() * factor.pseudoInverse();
  // Rows count as many fewer as successive ones are alike, all joints' mean.
  double scale = 1;
  if (null_) {
    scale = (null_->sigma2.cwiseProduct(null_->long_run))
                .cwiseQuotient(model_.residual_rms.cwiseAbs2())
                .mean();
  }
  std::vector<WatchedValue> values;
  for (Eigen::Index k = 0; k < p; ++k) {
    const ModelParameter& parameter = model_.parameters.parameters()[k];
    values.push_back({parameter.name, parameter.unit, model_.x[k] + change[k],
                      std::sqrt(scale) * inverse.row(k).norm()});
  }
  return values;
}

}  // namespace armcal
