#include "calib/drive_trains/robust_regression.h"

#include <Eigen/Cholesky>
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

// Of columns of length 1, those with a prior, and of the others those that are
// not combinations of each other.
std::vector<int> ColumnsToFit(const MatrixXd& A, const VectorXd& prior) {
  constexpr double kDependent = 1e-6;
  std::vector<int> columns, free;
  for (int k = 0; k < static_cast<int>(A.cols()); ++k) {
    (std::isfinite(prior[k]) ? columns : free).push_back(k);
  }
  Eigen::ColPivHouseholderQR<MatrixXd> qr(A(Eigen::all, free));
  qr.setThreshold(kDependent);
  for (int k = 0; k < qr.rank(); ++k) {
    columns.push_back(free[qr.colsPermutation().indices()[k]]);
  }
  std::sort(columns.begin(), columns.end());
  return columns;
}

VectorXd Reweighted(const MatrixXd& A, const VectorXd& y,
                    const VectorXd& information, VectorXd* left) {
  constexpr int kSteps = 15;  // of each loss
  VectorXd x = A.colPivHouseholderQr().solve(y);
  *left = y - A * x;
  for (const RobustLoss loss : {RobustLoss::kHuber, RobustLoss::kTukey}) {
    for (int step = 0; step < kSteps; ++step) {
      const double noise = RobustNoise(*left, y);
      VectorXd weight(y.size());
      for (Eigen::Index k = 0; k < y.size(); ++k) {
        weight[k] = EvaluateLoss(loss, (*left)[k] / noise).weight;
      }
      const MatrixXd weighted = weight.asDiagonal() * A;
      MatrixXd H = weighted.transpose() * A;
      H.diagonal() += noise * noise * information;
      x = H.ldlt().solve(weighted.transpose() * y);
      *left = y - A * x;
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

// The sandwich H^-1 (S + P) H^-1, H = sum slope a a' + P, P the prior's.
// Windows are twice as long as Andrews' optimum, for less of a bias.
MatrixXd CovarianceOf(const MatrixXd& A, const VectorXd& left, double noise,
                      const VectorXd& information,
                      const std::vector<bool>& follows) {
  constexpr int kLeastWindow = 8;  // the low pass makes four or so follow
  const auto p = static_cast<int>(A.cols());
  const MatrixXd P = (noise * noise * information).asDiagonal();
  MatrixXd H = P;
  std::vector<Score> scores;
  VectorXd weighted = left;
  for (Eigen::Index k = 0; k < left.size(); ++k) {
    const LossAt at = EvaluateLoss(RobustLoss::kTukey, left[k] / noise);
    const double slope = std::max(0., at.slope);
    const MatrixXd a = A.row(k);
    H += slope * a.transpose() * a;
    weighted[k] *= at.weight;
    scores.push_back({weighted[k] * a.transpose(), a, slope * a});
  }
  const MatrixXd gain = H.ldlt().solve(MatrixXd::Identity(p, p));
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

RobustRegression FitRobustly(const MatrixXd& A, const VectorXd& y,
                             const std::vector<bool>& follows,
                             const VectorXd& prior) {
  const Eigen::Index all = A.cols();
  const VectorXd length = A.colwise().norm().transpose().cwiseMax(1e-300);
  const MatrixXd scaled = A * length.cwiseInverse().asDiagonal();
  const std::vector<int> told = ColumnsToFit(scaled, prior);
  const MatrixXd some = scaled(Eigen::all, told);
  RobustRegression fit;
  fit.x = VectorXd::Zero(all);
  fit.covariance = MatrixXd::Zero(all, all);
  fit.told.setConstant(all, false);
  // Of x in units of the columns' lengths.
  const VectorXd information =
      prior.cwiseProduct(length).cwiseAbs2().cwiseInverse()(told);
  VectorXd left;
  const VectorXd x = Reweighted(some, y, information, &left);
  fit.noise = RobustNoise(left, y);
  fit.rms = left.norm() / std::sqrt(static_cast<double>(y.size()));
  fit.covariance(told, told) =
      CovarianceOf(some, left, fit.noise, information, follows);
  fit.x(told) = x;
  for (const int k : told) fit.told[k] = true;
  const VectorXd unit = length.cwiseInverse();
  fit.x = fit.x.cwiseProduct(unit).eval();
  fit.covariance =
      (unit.asDiagonal() * fit.covariance * unit.asDiagonal()).eval();
  return fit;
}

}  // namespace armcal
