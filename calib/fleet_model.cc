#include "calib/fleet_model.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A unit's logs together, in scaled parameters: with X = [1 t] of each log,
// L = sum information, B = sum X' information, A = sum X' information X.
struct Unit {
  MatrixXd L, B, A;
  VectorXd right, fixed_right;  // sum right, sum X' right
  double last = 0;              // scaled time of its last log
};

// What d_u and the fixed effects are, given T.
struct Solved {
  VectorXd beta;
  MatrixXd covariance;      // of beta
  VectorXd determined;      // share of each fixed effect that is seen
  std::vector<MatrixXd> V;  // Var(d | beta)
};

class Fleet {
 public:
  Fleet(const std::vector<UnitEvidence>& evidence, int units, bool drift);

  void Fit(const std::vector<bool>& left_out);
  // Tests all units; those beyond `most` sigmas.
  std::vector<FleetOutlier> Judge(int unit, double most, bool was_left_out,
                                  int at_most) const;
  double Limit(double level, double tests, int used, bool among) const;
  void Report(double level, FleetFit* fit) const;
  int size() const { return static_cast<int>(units_.size()); }
  int parameters() const { return static_cast<int>(scale_.size()); }

 private:
  VectorXd Scores(const Unit& unit, const MatrixXd& V) const {
    const VectorXd s = unit.right - unit.B.transpose() * solved_.beta;
    return s - unit.L * (V * s);
  }
  static MatrixXd Posterior(const Unit& unit, const VectorXd& root);
  VectorXd RootOf(int u, const std::vector<FleetOutlier>& outliers) const;
  void SolveFixed(const std::vector<bool>& left_out);
  double UpdateSpread(const std::vector<bool>& left_out);

  VectorXd scale_;  // unscaled = scale * scaled
  double reference_ = 0, time_scale_ = 1;
  bool drift_;
  std::vector<Unit> units_;
  VectorXd root_;  // of T, scaled
  Solved solved_;
};

// The pseudo-inverse of an information matrix, and which share of each entry
// it sees.
void Invert(const MatrixXd& H, MatrixXd* inverse, VectorXd* determined) {
  constexpr double kLeast = 1e-10;  // of the best seen direction
  const VectorXd size = H.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const MatrixXd scaled =
      size.cwiseInverse().asDiagonal() * H * size.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  const VectorXd& values = eigen.eigenvalues();
  const MatrixXd& vectors = eigen.eigenvectors();
  *inverse = MatrixXd::Zero(H.rows(), H.cols());
  *determined = VectorXd::Zero(H.rows());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (values[k] <= kLeast * values[values.size() - 1]) continue;
    const VectorXd v = vectors.col(k).cwiseQuotient(size);
    *inverse += v * v.transpose() / values[k];
    *determined += vectors.col(k).cwiseAbs2();
  }
}

Fleet::Fleet(const std::vector<UnitEvidence>& evidence, int units, bool drift)
    : drift_(drift), units_(units) {
  const Eigen::Index m = evidence.at(0).right.size();
  VectorXd total = VectorXd::Zero(m);
  double first = evidence[0].time, last = first;
  for (const UnitEvidence& e : evidence) {
    total += e.information.diagonal();
    reference_ += e.time / static_cast<double>(evidence.size());
    first = std::min(first, e.time), last = std::max(last, e.time);
  }
  if (last > first) time_scale_ = last - first;
  drift_ = drift_ && last > first;
  const double mean = 1. / units;
  scale_ = (mean * total).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  for (Eigen::Index k = 0; k < m; ++k) {
    if (total[k] <= 0) scale_[k] = 1;
  }
  const Eigen::Index p = drift_ ? 2 * m : m;
  for (Unit& unit : units_) {
    unit = {MatrixXd::Zero(m, m), MatrixXd::Zero(p, m), MatrixXd::Zero(p, p),
            VectorXd::Zero(m),    VectorXd::Zero(p),    -1e300};
  }
  for (const UnitEvidence& e : evidence) {
    Unit& unit = units_[e.unit];
    const double t = (e.time - reference_) / time_scale_;
    const MatrixXd L =
        scale_.asDiagonal() * e.information * scale_.asDiagonal();
    const VectorXd right = scale_.cwiseProduct(e.right);
    const double powers[] = {1, t, t * t};
    for (Eigen::Index a = 0; a < p / m; ++a) {
      unit.B.middleRows(a * m, m) += powers[a] * L;
      unit.fixed_right.segment(a * m, m) += powers[a] * right;
      for (Eigen::Index b = 0; b < p / m; ++b) {
        unit.A.block(a * m, b * m, m, m) += powers[a + b] * L;
      }
    }
    unit.L += L;
    unit.right += right;
    unit.last = std::max(unit.last, t);
  }
  root_ = VectorXd::Ones(m);
}

// (L + T^-1)^-1, also where T has zeros.
MatrixXd Fleet::Posterior(const Unit& unit, const VectorXd& root) {
  const MatrixXd one = MatrixXd::Identity(root.size(), root.size());
  const MatrixXd inner = one + root.asDiagonal() * unit.L * root.asDiagonal();
  return root.asDiagonal() * inner.llt().solve(one) * root.asDiagonal();
}

void Fleet::SolveFixed(const std::vector<bool>& left_out) {
  const Eigen::Index p = units_[0].A.rows();
  MatrixXd H = MatrixXd::Zero(p, p);
  VectorXd right = VectorXd::Zero(p);
  solved_.V.clear();
  for (size_t u = 0; u < units_.size(); ++u) {
    const Unit& unit = units_[u];
    solved_.V.push_back(Posterior(unit, root_));
    if (left_out[u]) continue;
    const MatrixXd BV = unit.B * solved_.V.back();
    H += unit.A - BV * unit.B.transpose();
    right += unit.fixed_right - BV * unit.right;
  }
  Invert(H, &solved_.covariance, &solved_.determined);
  solved_.beta = solved_.covariance * right;
}

// One step of the fixed point; the largest change of log T.
double Fleet::UpdateSpread(const std::vector<bool>& left_out) {
  constexpr double kNone = 1e-4;  // of what one unit's data tell apart
  const Eigen::Index m = root_.size();
  VectorXd squares = VectorXd::Zero(m), freedom = VectorXd::Zero(m);
  for (size_t u = 0; u < units_.size(); ++u) {
    if (left_out[u]) continue;
    const Unit& unit = units_[u];
    const MatrixXd& V = solved_.V[u];
    const MatrixXd G = V * unit.B.transpose();
    const VectorXd d = V * unit.right - G * solved_.beta;
    const VectorXd variance =
        V.diagonal() + (G * solved_.covariance).cwiseProduct(G).rowwise().sum();
    squares += d.cwiseAbs2();
    freedom += VectorXd::Ones(m) -
               variance.cwiseQuotient(root_.cwiseAbs2().cwiseMax(1e-300));
  }
  double change = 0;
  for (Eigen::Index k = 0; k < m; ++k) {
    if (root_[k] == 0) continue;
    const double before = root_[k] * root_[k];
    double now = squares[k] / std::max(freedom[k], 1e-3);
    // Far from the fixed point a step overshoots.
    now = std::clamp(now, before / 100, before * 100);
    root_[k] = now < kNone * kNone ? 0 : std::sqrt(now);
    // What is nothing beside the data's noise need not settle.
    const bool matters = root_[k] > .03;
    if (matters) change = std::max(change, std::abs(std::log(now / before)));
  }
  return change;
}

void Fleet::Fit(const std::vector<bool>& left_out) {
  constexpr int kMost = 60;
  constexpr double kSettled = .01;  // of variances
  root_ = root_.cwiseMax(.1);       // what was none may be some now
  for (int k = 0; k < kMost; ++k) {
    SolveFixed(left_out);
    if (UpdateSpread(left_out) < kSettled) break;
  }
  SolveFixed(left_out);
}

std::vector<FleetOutlier> Fleet::Judge(int u, double most, bool was_left_out,
                                       int at_most) const {
  const Unit& unit = units_[u];
  const MatrixXd& V = solved_.V[u];
  const MatrixXd M = unit.L - unit.L * V * unit.L;
  const MatrixXd J = (unit.B - unit.B * V * unit.L).transpose();
  // The mean has taken its share of a unit that it was fitted to.
  const MatrixXd S =
      M + (was_left_out ? 1. : -1.) * J * solved_.covariance * J.transpose();
  const VectorXd s = Scores(unit, V);
  std::vector<FleetOutlier> found;
  std::vector<int> named;
  VectorXd score = s;
  MatrixXd gain = MatrixXd::Identity(s.size(), s.size());  // score = gain s
  while (static_cast<int>(found.size()) < at_most) {
    FleetOutlier worst{u, -1, 0, 0, most};
    for (int k = 0; k < parameters(); ++k) {
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
      const double scale = scale_[named[k]];
      found[k].deviation = scale * deviation[k];
      found[k].stddev = scale * std::sqrt(std::max(0., inverse(k, k)));
    }
  }
  return found;
}

// Of Student's t when `used` units tell the spread.
double Fleet::Limit(double level, double tests, int used, bool among) const {
  const double freedom = std::max(1, used - (drift_ ? 2 : 1) - (among ? 1 : 0));
  const boost::math::students_t student(freedom);
  const double t = boost::math::quantile(
      boost::math::complement(student, level / tests / 2));
  // A unit among them has widened the spread that it is measured by.
  return among ? t * std::sqrt((freedom + 1) / (freedom + t * t)) : t;
}

// Of T for a unit whose named deviations are believed.
VectorXd Fleet::RootOf(int u, const std::vector<FleetOutlier>& outliers) const {
  VectorXd root = root_;
  for (const FleetOutlier& o : outliers) {
    if (o.unit != u) continue;
    double& r = root[o.parameter];
    r = std::max(r, std::abs(o.deviation) / scale_[o.parameter]);
  }
  return root;
}

void Fleet::Report(double level, FleetFit* fit) const {
  const int m = parameters();
  const auto kept = static_cast<int>(
      std::count(fit->left_out.begin(), fit->left_out.end(), false));
  const double beyond = Limit(level, m, kept, false);
  fit->reference_time = reference_;
  fit->has_drift = drift_;
  fit->mean = scale_.cwiseProduct(solved_.beta.head(m));
  fit->mean_stddev = scale_.cwiseProduct(
      solved_.covariance.diagonal().head(m).cwiseMax(0).cwiseSqrt());
  for (int k = 0; k < m; ++k) {
    fit->seen.push_back(solved_.determined[k] > 1 - 1e-6);
  }
  fit->spread = scale_.cwiseProduct(root_);
  fit->drift = fit->drift_stddev = VectorXd::Zero(m);
  fit->drifts.assign(m, false);
  if (drift_) {
    fit->drift = scale_.cwiseProduct(solved_.beta.tail(m)) / time_scale_;
    fit->drift_stddev =
        scale_.cwiseProduct(
            solved_.covariance.diagonal().tail(m).cwiseMax(0).cwiseSqrt()) /
        time_scale_;
    for (int k = 0; k < m; ++k) {
      fit->drifts[k] = solved_.determined[m + k] > 1 - 1e-6 &&
                       std::abs(fit->drift[k]) > beyond * fit->drift_stddev[k];
    }
  }
  fit->unit = fit->unit_stddev = MatrixXd::Zero(size(), m);
  fit->unit_time.resize(size());
  for (int u = 0; u < size(); ++u) {
    const Unit& unit = units_[u];
    const MatrixXd V = Posterior(unit, RootOf(u, fit->outliers));
    MatrixXd X = MatrixXd::Identity(m, solved_.beta.size());
    if (drift_) X.rightCols(m) = unit.last * MatrixXd::Identity(m, m);
    const MatrixXd G = X - V * unit.B.transpose();
    fit->unit.row(u) =
        scale_.cwiseProduct(G * solved_.beta + V * unit.right).transpose();
    const VectorXd variance =
        V.diagonal() + (G * solved_.covariance).cwiseProduct(G).rowwise().sum();
    fit->unit_stddev.row(u) =
        scale_.cwiseProduct(variance.cwiseMax(0).cwiseSqrt()).transpose();
    fit->unit_time[u] = reference_ + time_scale_ * unit.last;
  }
}

// Which units to leave out next; `back`: those that were and came back, for
// which the milder limit is the one for all.
std::vector<bool> OutOfTheOrdinary(const Fleet& fleet,
                                   const std::vector<bool>& left_out,
                                   std::vector<bool>* back) {
  constexpr double kOrdinary = .01;  // share of good units that is left out
  const int m = fleet.parameters();
  const auto used =
      static_cast<int>(std::count(left_out.begin(), left_out.end(), false));
  std::vector<bool> next;
  for (size_t u = 0; u < left_out.size(); ++u) {
    const bool among = !left_out[u] && !(*back)[u];
    const double limit = fleet.Limit(kOrdinary, m, used, among);
    next.push_back(
        !fleet.Judge(static_cast<int>(u), limit, left_out[u], 1).empty());
    (*back)[u] = (*back)[u] || (left_out[u] && !next[u]);
  }
  return next;
}

}  // namespace

FleetFit FitFleet(const std::vector<UnitEvidence>& evidence, int units,
                  const FleetOptions& options) {
  constexpr int kMostRounds = 10;
  constexpr int kMostNamed = 5;  // deviations of a unit
  Fleet fleet(evidence, units, options.drift);
  FleetFit fit;
  fit.left_out.assign(units, false);
  std::vector<bool> back = fit.left_out;
  while (!fit.settled && fit.rounds++ < kMostRounds) {
    fleet.Fit(fit.left_out);
    const std::vector<bool> next = OutOfTheOrdinary(fleet, fit.left_out, &back);
    fit.settled = next == fit.left_out;
    if (3 * std::count(next.begin(), next.end(), true) > units) break;
    if (fit.rounds < kMostRounds) fit.left_out = next;
  }
  const auto used = static_cast<int>(
      std::count(fit.left_out.begin(), fit.left_out.end(), false));
  const double tests = static_cast<double>(fleet.parameters()) * units;
  const double limit = fleet.Limit(options.false_alarms, tests, used, false);
  for (int u = 0; u < units; ++u) {
    if (!fit.left_out[u]) continue;
    for (const FleetOutlier& outlier :
         fleet.Judge(u, limit, true, kMostNamed)) {
      fit.outliers.push_back(outlier);
    }
  }
  fleet.Report(options.false_alarms, &fit);
  return fit;
}

}  // namespace armcal
