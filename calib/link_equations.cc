#include "calib/link_equations.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "calib/robust_rows.h"
#include "calib/score_covariance.h"
#include "calib/triangular_factor.h"
#include "problems/link_functions.h"
#include "problems/weak_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWider = 1.1;

// A second Coulomb column, of a slightly greater width, for each in `terms`
// that is free; `of` says which it belongs to.
std::vector<JointTermColumn> WiderColumns(const ArmUnknowns& unknowns,
                                          std::vector<int>* of) {
  std::vector<JointTermColumn> wider;
  for (size_t t = 0; t < unknowns.terms().size(); ++t) {
    const int k = unknowns.terms_begin() + static_cast<int>(t);
    if (unknowns.terms()[t].term != JointTerm::kCoulomb) continue;
    if (!unknowns.is_free(k)) continue;
    wider.push_back(unknowns.terms()[t]);
    wider.back().transition.width *= kWider;
    of->push_back(k);
  }
  return wider;
}

// Without the last `count` unknowns, which are estimated too.
void Eliminate(Eigen::Index count, LinkInformation* information) {
  if (count == 0) return;
  const Eigen::Index p = information->H.rows() - count;
  MatrixXd nuisance = information->H.bottomRightCorner(count, count);
  for (double& d : nuisance.diagonal()) d = d * (1 + 1e-9) + 1e-300;
  MatrixXd T(p, p + count);
  T << MatrixXd::Identity(p, p),
      -nuisance.ldlt()
           .solve(information->H.bottomLeftCorner(count, p))
           .transpose();
  information->H = (information->H.topRows(p) * T.transpose()).eval();
  information->S = (T * information->S * T.transpose()).eval();
  information->log_sums = (T * information->log_sums).eval();
}

// A symmetric matrix of torque columns among all unknowns.
MatrixXd Spread(const MatrixXd& A, const std::vector<int>& columns, int size) {
  MatrixXd all = MatrixXd::Zero(size, size);
  all(columns, columns) = A;
  return all;
}

}  // namespace

// A weak row of every joint at some values. U: columns of links, terms and
// torque_geometry.
struct LinkPass::Residual {
  const MatrixXd& U;
  const VectorXd& Y;
  VectorXd r;  // in noise units, 0 where the equation is not used
  int log;
  bool follows;  // right after the row before it
};

LinkPass::LinkPass(const ArmUnknowns& unknowns, const LinearCalibration& linear,
                   const Progress& progress, LogSet* logs)
    : unknowns_(unknowns), linear_(linear), progress_(progress), logs_(logs) {}

void LinkPass::ForEachResidual(
    const std::string& stage, const ArmValues& at, const VectorXd& noise,
    const std::vector<JointTermColumn>& terms,
    const std::function<void(const Residual&)>& visit) {
  const Robot robot = unknowns_.WithInertia(at);
  const ArmGeometry geometry = unknowns_.Geometry(at);
  std::vector<LinkFunctions> functions(
      logs_->size(),
      LinkFunctions(robot, terms, geometry, unknowns_.torque_geometry()));
  VectorXd x(unknowns_.tilt_begin());
  x << at.links, at.terms;
  int last_log = -1, last_segment = -1;
  logs_->ForEach(stage, progress_, [&](int log, const Trajectory& t) {
    functions[log].Enter(t);
    ForEachWeakRow(
        t, linear_.rows, &functions[log], [&](const IdentificationRow& row) {
          const bool follows = log == last_log && t.segment == last_segment;
          last_log = log, last_segment = t.segment;
          VectorXd r =
              (row.Y - row.U.leftCols(x.size()) * x).cwiseQuotient(noise);
          for (int i = 0; i < r.size(); ++i) {
            if (!linear_.used[log][i]) r[i] = 0;
          }
          visit({row.U, row.Y, r, log, follows});
        });
  });
}

LinkEquations LinkPass::Reduce(const ArmValues& at, const VectorXd& noise) {
  const std::vector<int> columns = unknowns_.TorqueColumns();
  const VectorXd about = at.Stacked()(columns).tail(
      static_cast<Eigen::Index>(unknowns_.torque_geometry().size()));
  const int n = unknowns_.num_links();
  TriangularFactor factor(static_cast<int>(columns.size()));
  std::vector<ResidualStatistics> statistics(n);
  ForEachResidual("links", at, noise, unknowns_.terms(),
                  [&](const Residual& residual) {
                    const VectorXd y =
                        residual.Y + residual.U.rightCols(about.size()) * about;
                    for (int i = 0; i < n; ++i) {
                      if (!linear_.used[residual.log][i]) continue;
                      statistics[i].Add(residual.r[i]);
                      factor.Add(residual.U.row(i), y[i],
                                 std::sqrt(Huber::Weight(residual.r[i])) /
                                     (noise[i] * linear_.inflation));
                    }
                  });
  const MatrixXd triangle = factor.Triangle();
  const Eigen::Index p = factor.columns();
  LinkEquations equations;
  equations.R = MatrixXd::Zero(p, unknowns_.size());
  equations.R(Eigen::all, columns) = triangle.topLeftCorner(p, p);
  equations.z = triangle.col(p).head(p);
  equations.spread.resize(n);
  for (int i = 0; i < n; ++i) {
    equations.spread[i] = statistics[i].RobustSpread();
  }
  return equations;
}

LinkInformation LinkPass::Inform(const ArmValues& at, const VectorXd& noise) {
  std::vector<JointTermColumn> terms = unknowns_.terms();
  std::vector<int> of;
  if (linear_.fitted_transitions) {
    const auto wider = WiderColumns(unknowns_, &of);
    terms.insert(terms.end(), wider.begin(), wider.end());
  }
  // LinkFunctions has the wider columns behind the terms; they go last here.
  const std::vector<int> columns = unknowns_.TorqueColumns();
  const Eigen::Index p = static_cast<Eigen::Index>(columns.size());
  const Eigen::Index before = unknowns_.tilt_begin();
  const Eigen::Index count = static_cast<Eigen::Index>(of.size());
  ScoreCovariance scores(static_cast<int>(p + count), linear_.score_window);
  LinkInformation information;
  information.H = MatrixXd::Zero(p + count, p + count);
  information.log_sums = MatrixXd::Zero(p + count, logs_->size());
  MatrixXd U(noise.size(), p + count);
  ForEachResidual(
      "covariance", at, noise, terms, [&](const Residual& residual) {
        U << residual.U.leftCols(before), residual.U.rightCols(p - before),
            residual.U.middleCols(before, count);
        for (Eigen::Index k = 0; k < count; ++k) U.col(p + k) -= U.col(of[k]);
        if (!residual.follows) scores.Break();
        VectorXd score = VectorXd::Zero(p + count);
        for (int i = 0; i < noise.size(); ++i) {
          if (!linear_.used[residual.log][i]) continue;
          const VectorXd u =
              U.row(i).transpose() / (noise[i] * linear_.inflation);
          const double r = residual.r[i];
          score += u * (r * Huber::Weight(r) / linear_.inflation);
          // Outside, Huber's loss is only linear.
          if (Huber::Inside(r)) {
            information.H.selfadjointView<Eigen::Lower>().rankUpdate(u);
          }
        }
        scores.Add(score);
        information.log_sums.col(residual.log) += score;
      });
  information.H = MatrixXd(information.H.selfadjointView<Eigen::Lower>());
  information.S = linear_.small_sample * scores.Value();
  Eliminate(count, &information);
  information.H = Spread(information.H, columns, unknowns_.size());
  information.S = Spread(information.S, columns, unknowns_.size());
  const MatrixXd sums = information.log_sums;
  information.log_sums = MatrixXd::Zero(unknowns_.size(), sums.cols());
  information.log_sums(columns, Eigen::all) = sums;
  return information;
}

}  // namespace armcal
