#include "calib/fleet/model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSeen = 1 - 1e-6;  // share of a parameter that is determined

// Tests a unit: its deviations of more than `most` sigmas, one given the other.
std::vector<FleetOutlier> Judge(const MixedModel& model, int u, double most,
                                bool was_left_out, int at_most) {
  const MixedModel::Unit& unit = model.unit(u);
  const MatrixXd& V = model.posterior(u);
  const MatrixXd M = unit.L - unit.L * V * unit.L;
  const MatrixXd J = (unit.B - unit.B * V * unit.L).transpose();
  // The mean has taken its share of a unit that it was fitted to.
  const MatrixXd S =
      M + (was_left_out ? 1. : -1.) * J * model.covariance() * J.transpose();
  const VectorXd left = unit.right - unit.B.transpose() * model.fixed();
  const VectorXd s = left - unit.L * (V * left);
  std::vector<FleetOutlier> found;
  std::vector<int> named;
  VectorXd score = s;
  MatrixXd gain = MatrixXd::Identity(s.size(), s.size());  // score = gain s
  while (static_cast<int>(found.size()) < at_most) {
    FleetOutlier worst{u, -1, 0, 0, most};
    for (int k = 0; k < model.parameters(); ++k) {
      const double information = gain.row(k) * M * gain.row(k).transpose();
      const double variance = gain.row(k) * S * gain.row(k).transpose();
      if (information < 1e-6 * M(k, k) || variance <= 0) continue;
      const double sigmas = std::abs(score[k]) / std::sqrt(variance);
      if (sigmas > worst.sigmas) {
        worst = {u, k, 0, 0, sigmas};
      }
    }
    if (worst.parameter < 0) break;
    found.push_back(worst);
    named.push_back(worst.parameter);
    // What the named deviations leave.
    const MatrixXd inverse =
        MatrixXd(M(named, named))
            .ldlt()
            .solve(MatrixXd::Identity(named.size(), named.size()));
    const VectorXd deviation = inverse * VectorXd(s(named));
    gain.setIdentity();
    gain(Eigen::all, named) -= M(Eigen::all, named) * inverse;
    score = gain * s;
    for (size_t k = 0; k < found.size(); ++k) {
      const double scale = model.scale()[named[k]];
      found[k].deviation = scale * deviation[k];
      found[k].stddev = scale * std::sqrt(std::max(0., inverse(k, k)));
    }
  }
  return found;
}

// Of Student's t when `used` units tell the spread.
double Limit(double level, double tests, int used, bool among, bool drift) {
  const double freedom = std::max(1, used - (drift ? 2 : 1) - (among ? 1 : 0));
  const boost::math::students_t student(freedom);
  const double t = boost::math::quantile(
      boost::math::complement(student, level / tests / 2));
  // A unit among them has widened the spread that it is measured by.
  return among ? t * std::sqrt((freedom + 1) / (freedom + t * t)) : t;
}

// Of T for a unit whose named deviations are believed.
VectorXd RootOf(const MixedModel& model, int u,
                const std::vector<FleetOutlier>& outliers) {
  VectorXd root = model.root();
  for (const FleetOutlier& o : outliers) {
    if (o.unit != u) continue;
    double& r = root[o.parameter];
    r = std::max(r, std::abs(o.deviation) / model.scale()[o.parameter]);
  }
  return root;
}

// Mean, spread and drift; which drift at this level.
void ReportFleet(const MixedModel& model, double level, FleetFit* fit) {
  const int m = model.parameters();
  const VectorXd& scale = model.scale();
  const VectorXd stddev = model.covariance().diagonal().cwiseMax(0).cwiseSqrt();
  const auto kept = static_cast<int>(
      std::count(fit->left_out.begin(), fit->left_out.end(), false));
  fit->reference_time = model.reference();
  fit->has_drift = model.has_drift();
  fit->mean = scale.cwiseProduct(model.fixed().head(m));
  fit->mean_stddev = scale.cwiseProduct(stddev.head(m));
  fit->spread = scale.cwiseProduct(model.root());
  fit->drift = fit->drift_stddev = VectorXd::Zero(m);
  fit->drifts.assign(m, false);
  for (int k = 0; k < m; ++k) {
    fit->seen.push_back(model.determined()[k] > kSeen);
  }
  if (!model.has_drift()) return;
  const VectorXd per_s = scale / model.time_scale();
  fit->drift = per_s.cwiseProduct(model.fixed().tail(m));
  fit->drift_stddev = per_s.cwiseProduct(stddev.tail(m));
  const double beyond = Limit(level, m, kept, false, true);
  for (int k = 0; k < m; ++k) {
    fit->drifts[k] = model.determined()[m + k] > kSeen &&
                     std::abs(fit->drift[k]) > beyond * fit->drift_stddev[k];
  }
}

void ReportUnits(const MixedModel& model, FleetFit* fit) {
  const int m = model.parameters();
  const VectorXd& scale = model.scale();
  fit->unit = fit->unit_stddev = MatrixXd::Zero(model.size(), m);
  fit->unit_time.resize(model.size());
  for (int u = 0; u < model.size(); ++u) {
    const MixedModel::Unit& unit = model.unit(u);
    const MatrixXd V = model.Posterior(u, RootOf(model, u, fit->outliers));
    MatrixXd X = MatrixXd::Identity(m, model.fixed().size());
    if (model.has_drift()) {
      X.rightCols(m) = unit.last * MatrixXd::Identity(m, m);
    }
    const MatrixXd G = X - V * unit.B.transpose();
    const VectorXd x = G * model.fixed() + V * unit.right;
    const VectorXd variance =
        V.diagonal() + (G * model.covariance()).cwiseProduct(G).rowwise().sum();
    fit->unit.row(u) = scale.cwiseProduct(x).transpose();
    fit->unit_stddev.row(u) =
        scale.cwiseProduct(variance.cwiseMax(0).cwiseSqrt()).transpose();
    fit->unit_time[u] = model.reference() + model.time_scale() * unit.last;
  }
}

// Which units to leave out next; `back`: those that were and came back, for
// which the milder limit is the one for all.
std::vector<bool> OutOfTheOrdinary(const MixedModel& model,
                                   const std::vector<bool>& left_out,
                                   std::vector<bool>* back) {
  constexpr double kOrdinary = .01;  // share of good units that is left out
  const int m = model.parameters();
  const auto used =
      static_cast<int>(std::count(left_out.begin(), left_out.end(), false));
  std::vector<bool> next;
  for (size_t u = 0; u < left_out.size(); ++u) {
    const bool among = !left_out[u] && !(*back)[u];
    const double limit = Limit(kOrdinary, m, used, among, model.has_drift());
    next.push_back(
        !Judge(model, static_cast<int>(u), limit, left_out[u], 1).empty());
    (*back)[u] = (*back)[u] || (left_out[u] && !next[u]);
  }
  return next;
}

}  // namespace

FleetFit FitFleet(const std::vector<UnitEvidence>& evidence, int units,
                  const FleetOptions& options) {
  constexpr int kMostRounds = 10;
  constexpr int kMostNamed = 5;  // deviations of a unit
  MixedModel model(evidence, units, options.drift);
  FleetFit fit;
  fit.left_out.assign(units, false);
  std::vector<bool> back = fit.left_out;
  while (!fit.settled && fit.rounds++ < kMostRounds) {
    model.Fit(fit.left_out);
    const std::vector<bool> next = OutOfTheOrdinary(model, fit.left_out, &back);
    fit.settled = next == fit.left_out;
    if (3 * std::count(next.begin(), next.end(), true) > units) break;
    if (fit.rounds < kMostRounds) fit.left_out = next;
  }
  const auto used = static_cast<int>(
      std::count(fit.left_out.begin(), fit.left_out.end(), false));
  const double tests = static_cast<double>(model.parameters()) * units;
  const double limit =
      Limit(options.false_alarms, tests, used, false, model.has_drift());
  for (int u = 0; u < units; ++u) {
    if (!fit.left_out[u]) continue;
    for (const FleetOutlier& outlier :
         Judge(model, u, limit, true, kMostNamed)) {
      fit.outliers.push_back(outlier);
    }
  }
  ReportFleet(model, options.false_alarms, &fit);
  ReportUnits(model, &fit);
  return fit;
}

}  // namespace armcal
