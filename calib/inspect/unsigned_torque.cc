#include "calib/inspect/unsigned_torque.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "calib/inspect/columns/folded_torque.h"
#include "calib/inspect/held_out_fit.h"
#include "calib/numerics/median.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSignRounds = 8;       // of signs and parameters
constexpr double kLeastTurned = .1;  // of the samples
// Of squares, before and after, in each half: more is explained than is left.
constexpr double kMostLeftOfSize = .5;

VectorXd SignsOf(const VectorXd& x) {
  return x.unaryExpr([](double value) { return value < 0 ? -1. : 1.; });
}

// What may have had the torque's sign: friction has the velocity's, inertia the
// acceleration's, gravity that of the position's side of where the torque is
// least.
std::vector<VectorXd> FirstSigns(const Motion& motion, const VectorXd& size,
                                 int j) {
  Eigen::Index least = 0;
  size.minCoeff(&least);
  const VectorXd side = motion.q.col(j).array() - motion.q(least, j);
  std::vector<VectorXd> signs;
  for (const VectorXd& x :
       {VectorXd(motion.qd.col(j)), VectorXd(motion.qdd.col(j)), side}) {
    signs.push_back(SignsOf(x));
    signs.push_back(-signs.back());
  }
  return signs;
}

// Of errors where the torque counts. A drive that rings as its joint turns
// round leaves a few large ones, which the torque's size folds to one side.
double MedianSquare(const VectorXd& errors, const VectorXd& tau) {
  std::vector<double> squares;
  for (Eigen::Index k = 0; k < errors.size(); ++k) {
    if (tau[k] != 0) squares.push_back(errors[k] * errors[k]);
  }
  return squares.empty() ? 0 : Quantile(squares, .5);
}

// Parameters fitted to one half with joint j's signs as the fit has them, by
// the best of all starts.
VectorXd FitWithSigns(const HeldOutHalves& halves, int half, int j) {
  const TorqueFit& fit = halves.fit(half);
  MatrixXd tau = fit.InMotion(halves.half(half).tau);
  const VectorXd size = tau.col(j).cwiseAbs();
  VectorXd best;
  double least = std::numeric_limits<double>::infinity();
  for (VectorXd signs : FirstSigns(halves.half(half).motion, size, j)) {
    VectorXd x;
    for (int round = 0; round < kSignRounds; ++round) {
      tau.col(j) = signs.cwiseProduct(size);
      x = fit.Parameters(tau);
      signs = SignsOf(fit.Torque(x).col(j));
    }
    const VectorXd torque = fit.Torque(x).col(j);
    const double left = (torque.cwiseAbs() - size).squaredNorm();
    if (left >= least) continue;
    least = left;
    best = x;
  }
  return best;
}

// What the size of a torque tells, by a fit and by where it comes near zero.
struct Asked {
  UnsignedTorque torque;
  bool is_clear = false;     // the fit alone tells
  int halves_that_fall = 0;  // in which it leaves less, held out, in squares
};

Asked Ask(const HeldOutHalves& halves, int j) {
  Asked asked{{j}, true};
  UnsignedTorque& found = asked.torque;
  double before = 0, after = 0, all = 0, samples = 0;
  for (int half = 0; half < 2; ++half) {
    const TorqueFit& judge = halves.fit(1 - half);
    const VectorXd unseen = judge.InMotion(halves.half(1 - half).tau).col(j);
    const VectorXd as_logged =
        judge.Torque(halves.fit(half).Parameters(halves.half(half).tau)).col(j);
    const VectorXd free = judge.Torque(FitWithSigns(halves, half, j)).col(j);
    const VectorXd of_logged = as_logged - unseen;
    const VectorXd of_size = free.cwiseAbs() - unseen.cwiseAbs();
    asked.is_clear &= MedianSquare(of_size, unseen) <
                      kMostLeftOfSize * MedianSquare(of_logged, unseen);
    asked.halves_that_fall += of_size.squaredNorm() < of_logged.squaredNorm();
    before += of_logged.squaredNorm();
    after += of_size.squaredNorm();
    found.turned +=
        static_cast<double>((free.array() * unseen.array() < 0).count());
    all += unseen.squaredNorm();
    samples += static_cast<double>((unseen.array() != 0).count());
  }
  found.turned /= samples;
  asked.is_clear &= after < before &&
                    std::min(found.turned, 1 - found.turned) >= kLeastTurned;
  found.before = 100 * std::sqrt(before / all);
  found.after = 100 * std::sqrt(after / all);
  return asked;
}

std::vector<Asked> AskAll(const Robot& robot, const WiringSamples& samples,
                          const std::vector<int>& joints) {
  std::vector<Asked> all;
  if (joints.empty()) return all;
  const HeldOutHalves halves(robot, samples);
  for (const int j : joints) all.push_back(Ask(halves, j));
  return all;
}

VectorXd SpeedAtRows(const UniformSeries& series, const Log& log, int j) {
  VectorXd speed(log.size());
  for (int k = 0; k < log.size(); ++k) {
    const auto row =
        static_cast<Eigen::Index>((log.t[k] - log.t[0]) / series.dt());
    speed[k] =
        series.motion().qd(std::min(row, series.motion().qd.rows() - 1), j);
  }
  return speed;
}

}  // namespace

std::vector<UnsignedTorque> FindUnsignedTorques(
    const Robot& robot, const WiringSamples& samples,
    const std::vector<int>& joints) {
  std::vector<UnsignedTorque> found;
  for (const Asked& asked : AskAll(robot, samples, joints)) {
    if (asked.is_clear) found.push_back(asked.torque);
  }
  return found;
}

std::vector<InspectionFinding> UnsignedFindings(
    const Robot& robot, const UniformSeries& series, const Log& log,
    const WiringSamples& samples, const std::vector<int>& joints) {
  std::vector<InspectionFinding> findings;
  for (const Asked& asked : AskAll(robot, samples, joints)) {
    const UnsignedTorque& lost = asked.torque;
    const Folds folds = FindFolds(log.tau.col(lost.joint),
                                  SpeedAtRows(series, log, lost.joint));
    const int agree = asked.halves_that_fall == 2 ? 2 : 0;
    const bool folds_tell =
        folds.HaveLostSign(static_cast<int>(joints.size()), agree);
    if (!asked.is_clear && !folds_tell) continue;
    std::string evidence;
    if (asked.is_clear || agree > 0) {
      evidence = Format(
          "of its size, held out, a fit leaves %.3g %% as logged and "
          "%.3g %% with both signs, the other in %.0f %% of the samples",
          lost.before, lost.after,
          100 * std::min(lost.turned, 1 - lost.turned));
    }
    if (folds_tell) {
      evidence += Format(
          "%s%d times it comes near zero and leaves again, and never on the "
          "other side",
          evidence.empty() ? "" : "; ", folds.visits);
    }
    findings.push_back({"unsigned_torque",
                        "the torque of " + robot.links[lost.joint].joint.name +
                            " has lost its sign",
                        evidence, "log the torque with its sign", lost.joint});
    if (!asked.is_clear && agree == 0) continue;
    findings.back().held_out_before = lost.before;
    findings.back().held_out_after = lost.after;
  }
  return findings;
}

}  // namespace armcal
