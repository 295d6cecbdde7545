#include "calib/drive_gains/fit.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/robust_rows.h"

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kOverflow = "the numbers of the logs overflow";

// Currents over the torques of the robot file, where it has them for all.
VectorXd Guess(const BlockTriangularFactor& factor, const VectorXd& nominal) {
  const int n = factor.num_joints();
  VectorXd current(n), torque(n);
  for (int i = 0; i < n; ++i) {
    const MatrixXd& R = factor.Triangle(i);
    const std::vector<int>& columns = factor.columns(i);
    torque[i] = (R.leftCols(columns.size()) * nominal(columns)).norm();
    current[i] = R.rightCols<1>().norm();
    if (current[i] == 0) current[i] = 1;
  }
  return torque.minCoeff() > 0 ? VectorXd(current.cwiseQuotient(torque))
                               : current;
}

class Fitter {
 public:
  Fitter(CurrentPass* pass, GainFit* fit) : pass_(*pass), fit_(*fit) {}

  void Start(const VectorXd& nominal);
  void Reweigh();
  void SolveRobustly(RobustLoss loss);

 private:
  int n() const { return static_cast<int>(fit_.noise.size()); }
  std::vector<CurrentEquations> Equations(const CurrentFactors& factors) const {
    return WhitenedEquations(factors, fit_.noise);
  }
  bool Refine(const CurrentFactors& factors) {
    if (RefineGains(Equations(factors), pass_.B(), fit_.reference,
                    &fit_.estimate)) {
      return true;
    }
    fit_.failure = kOverflow;
    return false;
  }
  double Moved(const CurrentFactors& factors, const GainEstimate& last) const;

  CurrentPass& pass_;
  GainFit& fit_;
};

// From no knowledge to an estimate.
void Fitter::Start(const VectorXd& nominal) {
  fit_.noise = UntiedNoise(fit_.factors);
  VectorXd rows(n()), clarity = VectorXd::Zero(n());
  for (int i = 0; i < n(); ++i) {
    fit_.equations = std::max(fit_.equations, fit_.factors.rows(i));
    rows[i] = fit_.noise[i] > 0 ? static_cast<double>(fit_.factors.rows(i)) : 0;
    if (rows[i] == 0) continue;
    clarity[i] = RightSideRms(fit_.factors.bare)[i] / fit_.noise[i];
  }
  const long needed = 2 * (n() + nominal.size() + 10);
  if (fit_.factors.bare.rows(0) == 0) {
    fit_.failure = "the logs of the bare arm hold no stretch of motion";
  } else if (pass_.has_payload() && fit_.factors.loaded.rows(0) == 0) {
    fit_.failure = "the logs with the payload hold no stretch of motion";
  } else if (fit_.equations < needed) {
    fit_.failure = "the logs hold " + std::to_string(fit_.equations) +
                   " equations of motion per joint, expected at least " +
                   std::to_string(needed) + ": longer logs are needed";
  } else if (!fit_.noise.allFinite()) {
    fit_.failure = kOverflow;
  } else if (rows.maxCoeff() == 0) {
    fit_.failure = "the currents in the logs are zero throughout";
  }
  if (!fit_.failure.empty()) return;
  clarity.maxCoeff(&fit_.reference);
  fit_.estimate = StartGains(Equations(fit_.factors), pass_.B(), rows,
                             Guess(fit_.factors.bare, nominal), fit_.reference);
}

// Solutions with re-estimated noise until that stays (2 %).
void Fitter::Reweigh() {
  for (int k = 0; k < 20; ++k) {
    if (!Refine(fit_.factors)) return;
    const VectorXd last = fit_.noise;
    fit_.noise = GainNoise(fit_.factors, pass_.B(), fit_.estimate, last);
    double change = 0;
    for (int i = 0; i < n(); ++i) {
      if (last[i] <= 0) continue;
      change = std::max(change, std::abs(std::log(fit_.noise[i] / last[i])));
    }
    if (change < 0.02) return;
  }
}

// How far inverse gains moved, in standard deviations.
double Fitter::Moved(const CurrentFactors& factors,
                     const GainEstimate& last) const {
  const GainSensitivity sensitivity(Equations(factors), pass_.B(),
                                    fit_.estimate, fit_.reference);
  const MatrixXd gain = sensitivity.Gain();
  double moved = 0;
  for (int j = 0; j < n(); ++j) {
    const VectorXd d = MassTimesInverseGainGradient(fit_, j);
    if (!sensitivity.Sees(d)) continue;
    const double change =
        MassTimesInverseGain(fit_.estimate, j) - MassTimesInverseGain(last, j);
    moved = std::max(
        moved, std::abs(change) / std::sqrt(std::max(1e-300, d.dot(gain * d))));
  }
  return moved;
}

// Weights by the solution before, noise by the residuals' robust spread, at
// least a thousandth of what it was.
void Fitter::SolveRobustly(RobustLoss loss) {
  constexpr int kMostPasses = 20;
  constexpr double kSettled = 0.1;  // standard deviations
  const VectorXd least = 1e-3 * fit_.noise;
  for (int k = 0; k < kMostPasses; ++k) {
    std::vector<ResidualStatistics> statistics(n());
    const CurrentFactors factors = pass_.Factors(
        "robust weights", fit_.estimate, fit_.noise,
        [loss](double r) { return EvaluateLoss(loss, r).weight; },
        [&](const CurrentRow& row) {
          for (int i = 0; i < n(); ++i) {
            if (fit_.noise[i] > 0) statistics[i].Add(row.r[i]);
          }
        });
    fit_.outliers.clear();
    for (int i = 0; i < n(); ++i) {
      fit_.outliers.push_back(statistics[i].outliers());
      if (fit_.noise[i] <= 0) continue;
      fit_.noise[i] =
          std::max(least[i], fit_.noise[i] * statistics[i].RobustSpread());
    }
    const GainEstimate last = fit_.estimate;
    if (!Refine(factors)) return;
    if (k > 0 && Moved(factors, last) < kSettled) return;
  }
}

}  // namespace

GainFit FitGains(const VectorXd& nominal, RobustLoss loss, CurrentPass* pass) {
  const int n = pass->parameters().num_joints();
  const GainEstimate none{VectorXd::Ones(n), VectorXd::Zero(nominal.size()),
                          VectorXd::Zero(10)};
  GainFit fit{"",
              none,
              0,
              VectorXd::Zero(n),
              {},
              0,
              pass->Factors(
                  "reading", none, VectorXd::Ones(n),
                  [](double) { return 1.0; }, [](const CurrentRow&) {})};
  Fitter fitter(pass, &fit);
  fitter.Start(nominal);
  if (fit.failure.empty()) fitter.Reweigh();
  if (fit.failure.empty() && loss != RobustLoss::kSquared)
    fitter.SolveRobustly(loss);
  return fit;
}

double MassTimesInverseGain(const GainEstimate& estimate, int joint) {
  return estimate.g[joint] * estimate.p[0];
}

VectorXd MassTimesInverseGainGradient(const GainFit& fit, int joint) {
  const GainEstimate& e = fit.estimate;
  const Index mass = e.g.size() + e.x.size();
  VectorXd d = VectorXd::Zero(mass + 10);
  d[mass] = e.g[joint];
  if (joint != fit.reference) d[joint] = e.p[0];
  return d;
}

}  // namespace armcal
