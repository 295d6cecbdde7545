#include "calib/diagnose/judge/joint_agreement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kMotionOfAJoint = .02;  // rad/s or m/s

// The tail probability of chi squared with `freedom` degrees below that of
// Limits().by_chance standard deviations of a normal variable.
bool IsMoreThanChance(double chi_squared, int freedom) {
  const boost::math::chi_squared chance(freedom);
  return boost::math::cdf(boost::math::complement(chance, chi_squared)) <
         ChanceBeyond();
}

// What was chosen as columns that come one after the other, without the
// baseline's own delay of all joints: given that no joint would see one, only
// its prior would tell that it is too large.
GapScreen WithoutTiming(const GapFit& fit) {
  GapScreen screen =
      fit.screen().Only(ColumnsOf(fit.candidates(), fit.selection().chosen));
  const std::vector<BaselineColumn>& columns = fit.baseline().columns();
  std::vector<int> timing;
  for (size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].kind == BaselineColumn::Kind::kTiming) {
      timing.push_back(static_cast<int>(c));
    }
  }
  screen.ScaleBaseline(timing, 0);
  return screen;
}

// What the refined effects leave of each joint, as the evidence weighs it,
// fitted with that screen. Their torque is as it is: a column, the derivative
// at a small size, has a large delay's form wrong otherwise on each joint.
JointRows LeftOf(const GapFit& fit, const GapScreen& screen) {
  const JointRows torque = fit.regression().TorqueOf(fit.refined().effects);
  const MatrixXd left = fit.data()->ResidualWith(
      screen.BaselineGiven(WhitenEach(fit.rows(), torque)), torque);
  JointRows rows(left.cols());
  for (int j = 0; j < left.cols(); ++j) {
    rows[j] = fit.rows().Whiten(j, left.col(j));
  }
  return rows;
}

// The linear parameters of the k-th effect in units of its columns, as refined.
VectorXd RefinedSize(const GapFit& fit, size_t k) {
  const GapCandidate& refined = fit.refined().effects[k];
  const GapCandidate& chosen = fit.candidates()[fit.selection().chosen[k]];
  VectorXd x(chosen.linear.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = refined.p[chosen.linear[i]] / chosen.size[i];
  }
  return x;
}

// What one joint's rows tell of an effect's sizes: by how much it would rather
// have them larger, and the inverse covariance of that.
struct Told {
  MatrixXd information;
  VectorXd further;
};

// From its rows P of the effect's columns and r of what is left with the sizes
// of all joints: d = A^-1 P'r, A = P'P. A ridge of 1e-9 keeps joints solvable
// that have one of two columns only.
Told ToldBy(const MatrixXd& P, const VectorXd& r) {
  Told told{P.transpose() * P, {}};
  told.information.diagonal().array() +=
      1e-9 * told.information.trace() + 1e-12;
  told.further = told.information.ldlt().solve(P.transpose() * r);
  return told;
}

std::vector<Told> ToldByJoints(const GapFit& fit, size_t k) {
  const GapScreen screen = WithoutTiming(fit);
  const JointRows left = LeftOf(fit, screen);
  const std::vector<int>& chosen = fit.selection().chosen;
  int first = 0;
  for (size_t i = 0; i < k; ++i) {
    first += static_cast<int>(fit.candidates()[chosen[i]].columns.size());
  }
  std::vector<JointRows> columns;
  for (size_t c = 0; c < fit.candidates()[chosen[k]].linear.size(); ++c) {
    columns.push_back(screen.Projected(first + static_cast<int>(c)));
  }
  std::vector<Told> told;
  for (int j = 0; j < screen.num_joints(); ++j) {
    MatrixXd P(screen.num_rows(j), static_cast<Eigen::Index>(columns.size()));
    for (size_t c = 0; c < columns.size(); ++c) {
      P.col(static_cast<Eigen::Index>(c)) = columns[c][j];
    }
    told.push_back(ToldBy(P, left[j]));
  }
  return told;
}

}  // namespace

bool JointAgreement::Differ(double form) const {
  return freedom > 0 && chi_squared > form * delta_chi2 &&
         IsMoreThanChance(chi_squared, freedom);
}

double JointAgreement::VarianceBetweenJoints() const {
  if (joints.size() < 2) return 0;
  double weights = 0, squares = 0;
  for (const JointSize& one : joints) {
    const double weight = 1 / (one.stddev * one.stddev);
    weights += weight;
    squares += weight * weight;
  }
  const double share = squares / (weights * weights);
  const double beyond = chi_squared - (static_cast<double>(joints.size()) - 1);
  return std::max(0., beyond) / (weights * (1 - share)) * share;
}

// The refined effect has one size x for all joints. With P_j its projected
// columns on joint j and r_j what all effects leave there, joint j by itself
// would have the size x + d_j,
//   d_j = A_j^-1 P_j' r_j,  A_j = P_j' P_j,
// and all of them together x + d, d = (sum A_j)^-1 sum A_j d_j. What joints
// differ by,
//   Q = sum_j d_j' A_j d_j - d' (sum_j A_j) d,
// is chi squared of (joints - 1) times as many degrees as there are columns
// where all joints have the same size: Cochran's Q of a meta-analysis (1954),
// in which each joint has the say that its own information gives it. Joints on
// which no more of the effect's squared torque is left than rounding are none
// that tell.
JointAgreement JointAgreementOn(const GapFit& fit, size_t k) {
  const VectorXd x = RefinedSize(fit, k);
  const int size = static_cast<int>(x.size());
  const std::vector<Told> told = ToldByJoints(fit, k);
  double all_told = 0;
  for (const Told& one : told) all_told += one.information.trace();
  JointAgreement agreement;
  int tell = 0;
  MatrixXd all = MatrixXd::Zero(size, size);
  VectorXd wanted = VectorXd::Zero(size);
  for (int j = 0; j < static_cast<int>(told.size()); ++j) {
    const auto& [information, further] = told[j];
    const bool tells_none = fit.screen().num_rows(j) == 0;
    if (tells_none && fit.scale().top_speed[j] < kMotionOfAJoint) continue;
    ++agreement.moving;
    if (tells_none) continue;
    const VectorXd alone = x + further;
    agreement.seen_by += IsMoreThanChance(alone.dot(information * alone), size);
    if (!(information.trace() > 1e-6 * all_told)) continue;
    if (size == 1) {
      const double unit = fit.candidates()[fit.selection().chosen[k]].size[0];
      agreement.joints.push_back(
          {j, unit * alone[0], std::abs(unit) / std::sqrt(information(0, 0))});
    }
    ++tell;
    agreement.chi_squared += further.dot(information * further);
    all += information;
    wanted += information * further;
  }
  if (tell == 0) return agreement;
  const VectorXd common = all.ldlt().solve(wanted);
  agreement.chi_squared -= wanted.dot(common);
  agreement.delta_chi2 = (x + common).dot(all * (x + common));
  agreement.freedom = (tell - 1) * size;
  return agreement;
}

}  // namespace armcal
