#include "calib/diagnose/judge/runs.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Columns of joint j's own terms, of which armature is not one that drifts.
std::vector<int> TermsOf(const GapBaseline& baseline, int j) {
  std::vector<int> terms;
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    if (column.kind == BaselineColumn::Kind::kTerm && column.joint == j &&
        static_cast<JointTerm>(column.index) != JointTerm::kArmature) {
      terms.push_back(c);
    }
  }
  return terms;
}

// Changes of some columns in one log alone, and their covariance.
struct OwnChange {
  VectorXd value;
  MatrixXd covariance;
};

// Rows of joint j per log.
std::vector<std::vector<int>> RowsOfLogs(const GapRows& rows, int j) {
  std::vector<std::vector<int>> logs(rows.segments().back().log + 1);
  const std::vector<GapRows::Place> places = rows.PlacesOfRows(j);
  for (size_t k = 0; k < places.size(); ++k) {
    logs[rows.segments()[places[k].segment].log].push_back(static_cast<int>(k));
  }
  return logs;
}

// By how much one log alone would have a joint's terms otherwise, given what
// the fit to all of them leaves: a ridge regression whose penalty is the prior
// of the term itself, which keeps a log that does not move the joint at 0.
OwnChange ChangeIn(const MatrixXd& columns, const VectorXd& left) {
  // As much as the prior of the parameter itself.
  const MatrixXd information =
      columns.transpose() * columns +
      MatrixXd::Identity(columns.cols(), columns.cols());
  OwnChange change;
  change.covariance = information.inverse();
  change.value = change.covariance * columns.transpose() * left;
  return change;
}

// The weighted line through the values, over the number of the log:
//   b = sum w (k - m) y_k / sum w (k - m)^2,  w = 1 / stddev^2.
// Its standard deviation is multiplied by the Birge ratio (1932), the rms of
// the values about the line over their own deviations, where that is above 1.
void FitLine(RunDrift* drift) {
  const Eigen::Index size = drift->value.size();
  const Eigen::ArrayXd weight = drift->stddev.array().square().inverse();
  const Eigen::ArrayXd number = Eigen::ArrayXd::LinSpaced(size, 0, size - 1);
  const double mean = (weight * number).sum() / weight.sum();
  const double level = (weight * drift->value.array()).sum() / weight.sum();
  const double spread = (weight * (number - mean).square()).sum();
  drift->per_log =
      (weight * (number - mean) * drift->value.array()).sum() / spread;
  const Eigen::ArrayXd left =
      drift->value.array() - level - drift->per_log * (number - mean);
  const double scatter =
      (weight * left.square()).sum() / static_cast<double>(size - 2);
  drift->per_log_stddev = std::sqrt(std::max(1., scatter) / spread);
}

// A line over the logs for each of joint j's terms; none where a log has no
// rows of the joint, since a line through the others would say nothing of it.
// The change of a log is told by the joint's own terms alone: inertias are
// those of all logs.
std::vector<RunDrift> DriftsOf(const GapFit& fit, const VectorXd& x, int j) {
  const GapBaseline& baseline = fit.baseline();
  const std::vector<int> terms = TermsOf(baseline, j);
  const std::vector<std::vector<int>> logs = RowsOfLogs(fit.rows(), j);
  if (terms.empty() || std::any_of(logs.begin(), logs.end(),
                                   [](const auto& k) { return k.empty(); })) {
    return {};
  }
  const MatrixXd columns =
      fit.rows().Whiten(j, fit.data()->columns()[j].Select(terms));
  std::vector<OwnChange> changes;
  for (const std::vector<int>& own : logs) {
    changes.push_back(ChangeIn(columns(own, Eigen::all), fit.Left(j)(own)));
  }
  const Joint joint = baseline.With(x).links[j].joint;
  std::vector<RunDrift> drifts;
  for (size_t i = 0; i < terms.size(); ++i) {
    const BaselineColumn& column = baseline.columns()[terms[i]];
    const JointTerm term = static_cast<JointTerm>(column.index);
    RunDrift drift;
    drift.name = joint.name + "." + JointTermName(term);
    drift.unit = JointTermUnit(term, joint.type);
    drift.value.resize(changes.size());
    drift.stddev.resize(changes.size());
    for (size_t k = 0; k < changes.size(); ++k) {
      drift.value[k] =
          TermOf(term, joint) + column.spread * changes[k].value[i];
      drift.stddev[k] = column.spread * std::sqrt(changes[k].covariance(i, i));
    }
    FitLine(&drift);
    drifts.push_back(drift);
  }
  return drifts;
}

}  // namespace

std::vector<RunDrift> ListRunDrifts(const GapFit& fit, const VectorXd& x) {
  std::vector<RunDrift> drifts;
  const int logs = fit.rows().segments().back().log + 1;
  if (logs < Limits().fewest_logs) return drifts;
  for (int j = 0; j < fit.rows().num_joints(); ++j) {
    for (const RunDrift& drift : DriftsOf(fit, x, j)) {
      if (std::abs(drift.per_log) >
          Limits().clear_of_many * drift.per_log_stddev) {
        drifts.push_back(drift);
      }
    }
  }
  return drifts;
}

}  // namespace armcal
