#include "calib/drive_trains/robust_regression.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "calib/linear/score_covariance.h"
#include "calib/numerics/median.h"
#include "problems/robust_loss.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Not below what rounding of the recorded numbers makes.
double RobustNoise(const VectorXd& left, const VectorXd& y) {
  constexpr double kNormal = 1.4826;  // standard deviations per median
  constexpr double kRounding = 1e-7;
  const VectorXd size = left.cwiseAbs();
  return std::max({kNormal * Median({size.begin(), size.end()}),
                   kRounding * y.cwiseAbs().maxCoeff(), 1e-12});
}

// Of columns of length 1 (or 0, which are left out) those with a prior, and of
// the others as many as are not combinations of each other. `told`: of these,
// those that no combination holds, so that what is fitted is their own.
std::vector<int> ColumnsToFit(const MatrixXd& A, const VectorXd& prior,
                              Eigen::Array<bool, Eigen::Dynamic, 1>* told) {
  constexpr double kDependent = 1e-6, kInCombination = 1e-2;
  std::vector<int> columns, free;
  told->setConstant(A.cols(), false);
  for (int k = 0; k < static_cast<int>(A.cols()); ++k) {
    if (A.col(k).squaredNorm() < .5) continue;
    (std::isfinite(prior[k]) ? columns : free).push_back(k);
  }
  for (const int k : columns) (*told)[k] = true;
  const MatrixXd some = A(Eigen::all, free);
  Eigen::ColPivHouseholderQR<MatrixXd> qr(some);
  qr.setThreshold(kDependent);
  for (int k = 0; k < qr.rank(); ++k) {
    columns.push_back(free[qr.colsPermutation().indices()[k]]);
  }
  std::sort(columns.begin(), columns.end());
  // Right singular vectors of what is (nearly) 0 are the combinations.
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(some.transpose() * some);
  const MatrixXd combinations =
      eigen.eigenvectors().leftCols(some.cols() - qr.rank());
  for (size_t k = 0; k < free.size(); ++k) {
    (*told)[free[k]] =
        combinations.row(static_cast<Eigen::Index>(k)).norm() < kInCombination;
  }
  return columns;
}

// In units of the columns' lengths, `information` the prior's.
struct ScaledRows {
  MatrixXd A, Z;
  const VectorXd& y;
  VectorXd information;
};

VectorXd Reweighted(const ScaledRows& rows, VectorXd* left) {
  constexpr int kMostSteps = 15;       // of each loss
  constexpr double kSmallStep = 1e-4;  // of the noise of a column's x
  VectorXd x = rows.A.colPivHouseholderQr().solve(rows.y);
  *left = rows.y - rows.A * x;
  for (const RobustLoss loss : {RobustLoss::kHuber, RobustLoss::kTukey}) {
    for (int step = 0; step < kMostSteps; ++step) {
      const double noise = RobustNoise(*left, rows.y);
      VectorXd weight(rows.y.size());
      for (Eigen::Index k = 0; k < weight.size(); ++k) {
        weight[k] = EvaluateLoss(loss, (*left)[k] / noise).weight;
      }
      const MatrixXd weighted = weight.asDiagonal() * rows.Z;
      MatrixXd H = weighted.transpose() * rows.A;
      H.diagonal() += noise * noise * rows.information;
      const VectorXd before = x;
      x = H.partialPivLu().solve(weighted.transpose() * rows.y);
      *left = rows.y - rows.A * x;
      if ((x - before).norm() < kSmallStep * noise) break;
    }
  }
  return x;
}

double LagOne(const VectorXd& left, const std::vector<bool>& follows) {
  double product = 0, square = 0;
  for (Eigen::Index k = 1; k < left.size(); ++k) {
    if (!follows[k]) continue;
    product += left[k] * left[k - 1];
    square += left[k] * left[k];
  }
  return square > 0 ? product / square : 0;
}

// The sandwich H^-1 (S + P) H^-T, H = sum slope z a' + P, P the prior's.
// Windows are twice as long as Andrews' optimum, for less of a bias.
MatrixXd CovarianceOf(const ScaledRows& rows, const VectorXd& left,
                      double noise, const std::vector<bool>& follows) {
  constexpr int kLeastWindow = 8;  // the low pass makes four or so follow
  const auto p = static_cast<int>(rows.A.cols());
  const MatrixXd P = (noise * noise * rows.information).asDiagonal();
  MatrixXd H = P;
  std::vector<Score> scores;
  VectorXd weighted = left;
  for (Eigen::Index k = 0; k < left.size(); ++k) {
    const LossAt at = EvaluateLoss(RobustLoss::kTukey, left[k] / noise);
    const double slope = at.slope;  // below 0 of gross errors (robust_loss.cc)
    const MatrixXd a = rows.A.row(k), z = rows.Z.row(k);
    H += slope * z.transpose() * a;
    weighted[k] *= at.weight;
    scores.push_back({weighted[k] * z.transpose(), z, slope * a});
  }
  const MatrixXd gain = H.partialPivLu().inverse();
  const auto count = static_cast<long>(left.size());
  const int window =
      2 * BartlettWindow(LagOne(weighted, follows), count, kLeastWindow);
  ScoreCovariance sum(p, window, gain);
  for (size_t k = 0; k < scores.size(); ++k) {
    if (!follows[k]) sum.Break();
    sum.Add(scores[k]);
  }
  return gain *
         (FixedShareExpansion(window, count) * sum.Value() +
          noise * noise * P) *
         gain.transpose();
}

}  // namespace

RobustRegression FitRobustly(const RegressionRows& rows) {
  constexpr double kNothing = 1e-100;  // shorter columns are 0
  const Eigen::Index all = rows.A.cols();
  const VectorXd unit =
      rows.A.colwise().norm().transpose().cwiseMax(kNothing).cwiseInverse();
  RobustRegression fit;
  const std::vector<int> told =
      ColumnsToFit(rows.A * unit.asDiagonal(), rows.prior, &fit.told);
  const VectorXd units = unit(told);
  const ScaledRows scaled = {
      rows.A(Eigen::all, told) * units.asDiagonal(),
      rows.Z(Eigen::all, told) * units.asDiagonal(), rows.y,
      rows.prior(told).cwiseQuotient(units).cwiseAbs2().cwiseInverse()};
  fit.x = VectorXd::Zero(all);
  fit.covariance = MatrixXd::Zero(all, all);
  VectorXd left;
  fit.x(told) = units.cwiseProduct(Reweighted(scaled, &left));
  fit.noise = RobustNoise(left, rows.y);
  fit.rms = left.norm() / std::sqrt(static_cast<double>(left.size()));
  const VectorXd size = left.cwiseAbs();
  fit.spread = Quantile({size.begin(), size.end()}, .9) / 1.645;
  fit.covariance(told, told) =
      units.asDiagonal() * CovarianceOf(scaled, left, fit.noise, rows.follows) *
      units.asDiagonal();
  return fit;
}

}  // namespace armcal
