#include "calib/refine/link_equations.h"

#include <Eigen/QR>
#include <cmath>

#include "calib/linear/robust_reduction.h"
#include "calib/linear/row_reduction.h"
#include "calib/numerics/posterior.h"
#include "calib/numerics/triangular_factor.h"
#include "model/dynamics/base_inertials.h"
#include "problems/link_functions.h"
#include "problems/weak_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWider = 1.1;

// Takes the last `count` unknowns out, which are estimated too and would
// otherwise count as known. QR of the columns with these first gives
//   R = [N C; 0 R_2],
// where R_2'R_2 is the Schur complement, the information about the others that
// is left. Scores follow by T, s_p - (N^-1 C)' s_n.
void Eliminate(Eigen::Index count, LinkInformation* information) {
  if (count == 0) return;
  const Eigen::Index p = information->R.cols() - count;
  MatrixXd turned(information->R.rows(), p + count);
  turned << information->R.rightCols(count), information->R.leftCols(p);
  const Eigen::HouseholderQR<MatrixXd> qr(turned);
  const MatrixXd R = qr.matrixQR().triangularView<Eigen::Upper>();
  MatrixXd nuisance = R.topLeftCorner(count, count);
  for (double& d : nuisance.diagonal()) d = d == 0 ? 1 : d;  // not seen
  MatrixXd T(p, p + count);
  T << MatrixXd::Identity(p, p), -nuisance.triangularView<Eigen::Upper>()
                                      .solve(R.topRightCorner(count, p))
                                      .transpose();
  information->R = R.bottomRightCorner(R.rows() - count, p);
  information->S = (T * information->S * T.transpose()).eval();
  information->log_sums = (T * information->log_sums).eval();
  information->scale_sums = (T * information->scale_sums).eval();
  information->least.conservativeResize(p);
}

// Puts the columns of the torques' unknowns to their places among all.
LinkInformation Spread(const LinkInformation& torques,
                       const std::vector<int>& columns, int size) {
  LinkInformation all;
  all.R = MatrixXd::Zero(torques.R.rows(), size);
  all.R(Eigen::all, columns) = torques.R;
  all.S = MatrixXd::Zero(size, size);
  all.S(columns, columns) = torques.S;
  all.log_sums = MatrixXd::Zero(size, torques.log_sums.cols());
  all.log_sums(columns, Eigen::all) = torques.log_sums;
  all.scale_sums = MatrixXd::Zero(size, torques.scale_sums.cols());
  all.scale_sums(columns, Eigen::all) = torques.scale_sums;
  all.least = VectorXd::Zero(size);
  all.least(columns) = torques.least;
  return all;
}

// The score U' psi(r) of a row, in units in which weights are 1.
Score LinkScore(const FittedRow& row) {
  Score score{row.U.transpose() * row.r, row.U, {}};
  for (int i = 0; i < row.r.size(); ++i) {
    if (!row.used[i]) score.C.row(i).setZero();
  }
  score.U = row.slope.asDiagonal() * score.C;
  return score;
}

}  // namespace

// A weak row of every joint at some values. U: columns of links, terms and
// torque_geometry.
struct LinkPass::Residual {
  const MatrixXd& U;
  VectorXd y;  // right side, in noise units
  VectorXd r;  // the same of the residual, 0 where the equation is not used
  int log;
  bool follows;  // right after the row before it
};

// The columns of an information: those of the torques' unknowns, then wider
// Coulomb columns, less the columns they belong to.
struct LinkPass::Columns {
  Columns(const ArmUnknowns& unknowns, bool with_wider)
      : torques(unknowns.TorqueColumns()),
        terms(unknowns.terms()),
        rigid(unknowns.tilt_begin()) {
    for (size_t t = 0; with_wider && t < unknowns.terms().size(); ++t) {
      const int k = unknowns.terms_begin() + static_cast<int>(t);
      if (unknowns.terms()[t].term != JointTerm::kCoulomb) continue;
      if (!unknowns.is_free(k)) continue;
      terms.push_back(unknowns.terms()[t]);
      terms.back().transition.width *= kWider;
      wider.push_back(k);
    }
  }
  Eigen::Index num_torques() const { return torques.size(); }
  Eigen::Index num_wider() const { return wider.size(); }
  Eigen::Index size() const { return num_torques() + num_wider(); }
  // LinkFunctions has the wider columns behind the terms.
  MatrixXd Sorted(const MatrixXd& U) const {
    MatrixXd sorted(U.rows(), size());
    sorted << U.leftCols(rigid), U.rightCols(num_torques() - rigid),
        U.middleCols(rigid, num_wider());
    for (Eigen::Index k = 0; k < num_wider(); ++k) {
      sorted.col(num_torques() + k) -= U.col(wider[k]);
    }
    return sorted;
  }

  std::vector<int> torques;
  std::vector<JointTermColumn> terms;
  Eigen::Index rigid;      // columns of links and terms
  std::vector<int> wider;  // the columns they belong to
};

VectorXd EquationNoise(const LinearCalibration& linear) {
  constexpr double kLeast = 1e-5;  // of the torque
  if (!linear.training) return linear.noise;
  return linear.noise.cwiseMax(kLeast * linear.training->moving().torque_rms);
}

LinkPass::LinkPass(const ArmUnknowns& unknowns, const LinearCalibration& linear,
                   const Progress& progress, const PreparedLogs& logs)
    : unknowns_(unknowns), linear_(linear), progress_(progress), logs_(logs) {}

// Makes every weak row U x = y at some values and its residual. Columns of the
// geometry are derivatives there and no part of the torque, U_links,terms x.
void LinkPass::ForEachResidual(
    const std::string& stage, const ArmValues& at, const VectorXd& noise,
    const std::vector<JointTermColumn>& terms,
    const std::function<void(const Residual&)>& visit) {
  std::vector<LinkFunctions> functions(
      logs_.size(),
      LinkFunctions(unknowns_.WithInertia(at), terms, unknowns_.Geometry(at),
                    unknowns_.torque_geometry()));
  VectorXd x(unknowns_.tilt_begin());
  x << at.links, at.terms;
  int last_log = -1, last_segment = -1;
  logs_.ForEach(stage, progress_, [&](int log, const Trajectory& t) {
    functions[log].Enter(t);
    const WeakRows rows(t, linear_.rows, functions[log]);
    ForEachRowOnThreads(
        rows, functions[log], [&](const IdentificationRow& row) {
          const bool follows = log == last_log && t.segment == last_segment;
          last_log = log, last_segment = t.segment;
          const VectorXd y = row.Y.cwiseQuotient(noise);
          VectorXd r = y - (row.U.leftCols(x.size()) * x).cwiseQuotient(noise);
          for (int i = 0; i < r.size(); ++i) {
            if (!linear_.used[log][i]) r[i] = 0;
          }
          visit({row.U, y, r, log, follows});
        });
  });
}

// Compresses all rows to R x = z. A known geometry tells some combinations of
// inertial parameters only (base parameters: Gautier & Khalil 1990, IEEE T-RA
// 6), and the columns of the others are combinations of theirs in all rows, and
// so in what rows are reduced to. Only base columns are evaluated and factored,
// 36 instead of 60 for a PUMA (Mayeda, Yoshida & Osuka 1990), and R is expanded
// afterwards.
//
// Errors of rows follow each other, and R'R would be too sure against poses and
// the file. Division by the linear calibration's inflation, the median of its
// deviations over those of independent rows, makes up for it.
LinkEquations LinkPass::Reduce(const ArmValues& at, const VectorXd& noise) {
  const Robot robot = unknowns_.WithInertia(at);
  const ArmGeometry geometry = unknowns_.Geometry(at);
  const BaseInertials base(geometry.ApplyTo(robot));
  std::vector<LinkFunctions> functions(
      logs_.size(), LinkFunctions(robot, unknowns_.terms(), geometry,
                                  unknowns_.torque_geometry(), base.columns));
  const std::vector<int> columns = unknowns_.TorqueColumns();
  const auto others =
      static_cast<Eigen::Index>(columns.size()) - base.combinations.cols();
  RobustReduction::Point point;
  point.x.resize(functions[0].size());
  point.x << base.combinations * at.links, at.Stacked()(columns).tail(others);
  point.nonlinear = static_cast<int>(unknowns_.torque_geometry().size());
  point.noise = noise;
  point.loss = linear_.loss;
  RobustReduction reduction(point, functions[0], RowsPerLeaf(linear_.rows));
  logs_.ForEach("links", progress_, [&](int log, const Trajectory& t) {
    functions[log].Enter(t);
    reduction.Add(WeakRows(t, linear_.rows, functions[log]), linear_.used[log]);
  });
  const MatrixXd triangle = reduction.Triangle() / linear_.inflation;
  const Eigen::Index p = triangle.cols() - 1;
  MatrixXd R(p, columns.size());
  R << triangle.topLeftCorner(p, p - others) * base.combinations,
      triangle.block(0, p - others, p, others);
  LinkEquations equations;
  equations.R = MatrixXd::Zero(p, unknowns_.size());
  equations.R(Eigen::all, columns) = R;
  equations.z = triangle.col(p).head(p);
  equations.spread.resize(unknowns_.num_links());
  for (int i = 0; i < unknowns_.num_links(); ++i) {
    equations.spread[i] = reduction.spread(i).Value();
  }
  return equations;
}

// A row whitened like the equations of Reduce.
FittedRow LinkPass::MakeFittedRow(const Residual& residual,
                                  const Columns& columns,
                                  const VectorXd& noise) const {
  const VectorXd whiten = (linear_.inflation * noise).cwiseInverse();
  FittedRow row{whiten.asDiagonal() * columns.Sorted(residual.U),
                residual.r / linear_.inflation, linear_.used[residual.log],
                VectorXd(residual.r.size())};
  for (int i = 0; i < row.r.size(); ++i) {
    const LossAt loss = EvaluateLoss(linear_.loss, residual.r[i]);
    row.r[i] *= loss.weight;
    row.slope[i] = InformingSlope(loss);
  }
  return row;
}

// (A + P)^-1 of the torques' unknowns, all others known.
MatrixXd LinkPass::Gain(const MatrixXd& R, const Columns& columns,
                        const MatrixXd& others, const MatrixXd& prior) const {
  const Eigen::Index count = columns.num_torques(), size = columns.size();
  MatrixXd A = MatrixXd::Zero(R.rows() + others.rows(), size);
  A.topRows(R.rows()) = R;
  A.bottomLeftCorner(others.rows(), count) =
      others(Eigen::all, columns.torques);
  MatrixXd P = MatrixXd::Zero(size, size);
  P.topLeftCorner(count, count) = prior(columns.torques, columns.torques);
  std::vector<int> free;
  for (int k = 0; k < size; ++k) {
    if (k >= count || unknowns_.is_free(columns.torques[k])) free.push_back(k);
  }
  return Posterior(A, P, free).Gain();
}

// Two passes: the first sums the information, from which the gain follows; the
// second sums the scores' long-run covariance, which needs the gain for what
// the fit took of the residuals (ScoreCovariance, OverlapCovariance). With
// fitted widths, wider Coulomb columns stand for the derivative by the width,
// as in the linear calibration, and are eliminated at the end.
LinkInformation LinkPass::Inform(const ArmValues& at, const VectorXd& noise,
                                 const MatrixXd& others,
                                 const MatrixXd& prior) {
  const Columns columns(unknowns_, linear_.fitted_transitions);
  const Eigen::Index size = columns.size();
  const auto run = [&](const std::string& stage, const auto& visit) {
    ForEachResidual(
        stage, at, noise, columns.terms, [&](const Residual& residual) {
          const FittedRow row = MakeFittedRow(residual, columns, noise);
          visit(residual, row, LinkScore(row));
        });
  };
  TriangularFactor factor(static_cast<int>(size));
  run("information",
      [&](const Residual&, const FittedRow& row, const Score& score) {
        for (Eigen::Index i = 0; i < score.C.rows(); ++i) {
          factor.Add(score.C.row(i), 0, std::sqrt(row.slope[i]));
        }
      });
  LinkInformation information;
  information.R = factor.Triangle().topLeftCorner(size, size);
  const MatrixXd gain = Gain(information.R, columns, others, prior);
  ScoreCovariance scores(static_cast<int>(size), linear_.score_window, gain);
  const int n = unknowns_.num_links();
  OverlapCovariance overlap(n, static_cast<int>(size), linear_.rows_per_window);
  information.log_sums = MatrixXd::Zero(size, logs_.size());
  information.scale_sums = MatrixXd::Zero(size, n);
  run("covariance",
      [&](const Residual& residual, const FittedRow& row, const Score& score) {
        if (!residual.follows) scores.Break(), overlap.Break();
        scores.Add(score);
        overlap.Add(row);
        information.log_sums.col(residual.log) += score.value;
        information.scale_sums +=
            score.U.transpose() * (residual.y / linear_.inflation).asDiagonal();
      });
  information.S = scores.Value();
  information.least = overlap.Value(gain, VectorXd::Ones(n)).diagonal();
  Eliminate(columns.num_wider(), &information);
  return Spread(information, columns.torques, unknowns_.size());
}

}  // namespace armcal
