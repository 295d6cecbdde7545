#include "calib/inspect/held_out_fit.h"

#include <cmath>

namespace armcal {
namespace {

using Eigen::VectorXd;

// A stretch of the shortest logs, of 4 s, is then a period of the 8 Hz below
// which torques are compared: most of its samples are not the other half's
// neighbours, and each joint goes both ways in both halves.
constexpr int kStretches = 32;
// Of the torque's squares: no model leaves less than 1 % of the torque.
constexpr double kLeastRelative = 1e-4;
// Of squares. What is claimed has to explain more than it leaves: structured
// errors of a model that is read rightly trade with each other below that.
constexpr double kHalf = .5;
// Of squares of the joints concerned, where the others outweigh them. Wrong
// readings of right logs of ../shared/data leave a fifth or more (the double
// pendulum's), planted ones of the logs named BUILD in
// tests/real/planted_faults.py a tenth to a thousandth.
constexpr double kTenth = .1;

// Of squares in both halves and in all samples: whether those of the halves
// together, which is two-fold cross-validation, and those of all samples fall
// by a factor of 1.5, and neither half's rise.
bool CrossValidatesBetter(const Eigen::Vector3d& before,
                          const Eigen::Vector3d& after) {
  constexpr double kFactor = 1 + kHalf;
  return (after.head<2>().array() < before.head<2>().array()).all() &&
         kFactor * (after.head<2>().sum() + 2 * kLeastRelative) <
             before.head<2>().sum() + 2 * kLeastRelative &&
         kFactor * (after[2] + kLeastRelative) < before[2] + kLeastRelative;
}

// Nats per sample by which `changed` leaves less, half the log of squares.
double Gain(const HeldOutFit& as_is, const HeldOutFit& changed, int row) {
  return .5 * ((as_is.joints.row(row).array() + kLeastRelative).log() -
               (changed.joints.row(row).array() + kLeastRelative).log())
                  .sum();
}

}  // namespace

HeldOutHalves::HeldOutHalves(const Robot& robot, const WiringSamples& samples) {
  const Eigen::Index size = samples.tau.rows();
  for (Eigen::Index k = 0; k < size; ++k) {
    rows_[k * kStretches / size % 2].push_back(static_cast<int>(k));
  }
  for (int h = 0; h < 2; ++h) {
    WiringSamples half;
    half.motion.dt = samples.motion.dt;
    half.motion.q = Rows(samples.motion.q, h);
    half.motion.qd = Rows(samples.motion.qd, h);
    half.motion.qdd = Rows(samples.motion.qdd, h);
    half.tau = Rows(samples.tau, h);
    fits_.emplace_back(robot, half.motion);
    halves_.push_back(std::move(half));
  }
}

HeldOutFit FitHeldOut(const Robot& robot, const WiringSamples& samples) {
  const HeldOutHalves halves(robot, samples);
  const TorqueFit whole(robot, samples.motion);
  const auto size = static_cast<double>(samples.tau.rows());
  const Eigen::MatrixXd tau = whole.InMotion(samples.tau);
  const VectorXd all = tau.colwise().squaredNorm() / size;
  HeldOutFit result;
  result.joints.resize(3, samples.tau.cols());
  const auto set = [&](int row, const VectorXd& squares, double count) {
    result.joints.row(row) =
        (squares / count).cwiseQuotient((all.array() + 1e-18).matrix());
    result.all[row] = squares.sum() / count / (all.sum() + 1e-300);
  };
  for (int h = 0; h < 2; ++h) {
    const Eigen::MatrixXd& unseen = halves.half(1 - h).tau;
    const VectorXd x = halves.fit(h).Parameters(halves.half(h).tau);
    set(h, halves.fit(1 - h).Squares(x, unseen),
        static_cast<double>(unseen.rows()));
  }
  set(2, whole.Squares(whole.Parameters(samples.tau), samples.tau), size);
  const VectorXd counts =
      whole.InMotion(Eigen::MatrixXd::Ones(tau.rows(), tau.cols()))
          .colwise()
          .sum();
  const VectorXd sums = tau.colwise().sum();
  result.variation =
      1 - sums.array().square() / (counts.array() * all.array() * size + 1e-18);
  result.residual_percent =
      100 * std::sqrt(.5 * (result.all[0] + result.all[1]));
  return result;
}

HeldOutFit OfColumns(const HeldOutFit& fit, const std::vector<int>& column) {
  HeldOutFit sorted = fit;
  for (size_t j = 0; j < column.size(); ++j) {
    const auto from = static_cast<Eigen::Index>(j);
    sorted.joints.col(column[j]) = fit.joints.col(from);
    sorted.variation[column[j]] = fit.variation[from];
  }
  return sorted;
}

bool IsClearlyBetter(const HeldOutFit& as_is, const HeldOutFit& changed,
                     const std::vector<int>& of) {
  if (!(changed.residual_percent < as_is.residual_percent)) return false;
  for (int row = 0; row < 3; ++row) {
    double before = 0, after = 0;
    for (const int j : of) {
      before += as_is.joints(row, j) + kLeastRelative;
      after += changed.joints(row, j) + kLeastRelative;
      if (!(changed.joints(row, j) < kHalf)) return false;
    }
    const bool of_all = changed.all[row] + kLeastRelative <
                            kHalf * (as_is.all[row] + kLeastRelative) &&
                        changed.all[row] < kHalf;
    if (!of_all && !(after < kTenth * before)) return false;
  }
  return true;
}

bool IsFirstToExplain(const HeldOutFit& as_is, const HeldOutFit& changed,
                      int j) {
  for (int row = 0; row < 3; ++row) {
    const double before = as_is.joints(row, j), after = changed.joints(row, j);
    const double half = kHalf * as_is.variation[j];
    if (!(before > half && after < half && after < kHalf * before)) {
      return false;
    }
  }
  return changed.residual_percent < as_is.residual_percent;
}

bool IsBetterSign(const HeldOutFit& as_is, const HeldOutFit& changed, int j) {
  return CrossValidatesBetter(as_is.all, changed.all) &&
         CrossValidatesBetter(as_is.joints.col(j), changed.joints.col(j)) &&
         (changed.joints.col(j).array() < kHalf).all();
}

bool IsBetterForAll(const HeldOutFit& as_is, const HeldOutFit& changed) {
  const auto joints = static_cast<double>(as_is.joints.cols());
  for (int row = 0; row < 3; ++row) {
    // What is explained is half of what is left, in the joints' mean.
    if (!(Gain(as_is, changed, row) > .5 * joints * std::log(1 + kHalf)) ||
        !(changed.all[row] < kHalf) || !(as_is.all[row] < kHalf)) {
      return false;
    }
    // Nor may one joint leave half more than before.
    for (Eigen::Index j = 0; j < as_is.joints.cols(); ++j) {
      if (changed.joints(row, j) >
          (1 + kHalf) * (as_is.joints(row, j) + kLeastRelative)) {
        return false;
      }
    }
  }
  return changed.residual_percent < as_is.residual_percent;
}

bool IsBetterInTotal(const HeldOutFit& as_is, const HeldOutFit& changed) {
  return ((1 + kHalf) * (changed.all.array() + kLeastRelative) <
          as_is.all.array() + kLeastRelative)
      .all();
}

}  // namespace armcal
