#include "calib/watch/null_model.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSecondsPerHour = 3600;
// Rows of which half their window lies in changes of sign are those.
constexpr double kCrossing = .2;
// Of which this much lies there, their residual is another than elsewhere.
constexpr double kTouched = .002;
constexpr double kStanding = .02;  // of its variance, where a joint moves
constexpr long kFewest = 100;      // rows that a variance is learned from
// Changes are tested at the end of each such block of rows (watcher.h).
constexpr double kTestsPerSecond = 4;
constexpr double kLongestWindow = 16;  // s, that changes are looked for in
constexpr double kWanderWindow = 2;    // s, of the parameters' seeming changes
constexpr int kWanderSteps = 40;       // of expectation and maximization

// A joint that passes through zero has been "standing" for a twentieth, which
// is then next to nothing; one that starts slowly keeps it for a while.
VectorXd Stands(const VectorXd& standing) { return standing.cwiseAbs2(); }

// A level of a Gaussian whose variance is known, for one whose variance was
// learned from so many independent values: its predictive distribution is
// Student's, whose tail (1 + h^2 / dof)^(-dof / 2) has exp(-level^2 / 2) at h.
double StudentLevel(double level, double dof) {
  return std::sqrt(dof * std::expm1(level * level / dof));
}

std::vector<VectorXd> Residuals(const std::vector<WatchRow>& rows,
                                const VectorXd& mean) {
  std::vector<VectorXd> residuals;
  for (const WatchRow& row : rows) {
    residuals.push_back(row.r - row.A.leftCols(mean.size()) * mean);
  }
  return residuals;
}

// Variances of joint j far from changes of its friction's sign, and what is
// more near them, per share of the window that lies there. What a joint that
// stands may hold is anything within its Coulomb friction: uniform, f^2 / 3.
void LearnVariances(const std::vector<WatchRow>& rows,
                    const std::vector<VectorXd>& residuals,
                    const WatchModel& model, NullModel* null) {
  const int n = model.num_joints();
  for (int j = 0; j < n; ++j) {
    double far = 0, near = 0, share = 0;
    long far_rows = 0, near_rows = 0;
    for (size_t k = 0; k < rows.size(); ++k) {
      const double square = residuals[k][j] * residuals[k][j];
      if (rows[k].crossing[j] > kCrossing) {
        near += square;
        share += rows[k].crossing[j];
        ++near_rows;
      } else {
        far += square;
        ++far_rows;
      }
    }
    const double coulomb = model.robot.links[j].joint.coulomb;
    const double uniform = coulomb * coulomb / 3;
    const bool moved = far_rows >= kFewest;
    null->sigma2[j] = moved ? far / far_rows : near / std::max(near_rows, 1L);
    null->sigma2[j] = std::max(
        null->sigma2[j], 1e-12 * model.torque_rms[j] * model.torque_rms[j]);
    null->standing2[j] = uniform;
    null->crossing2[j] =
        near_rows >= kFewest && moved
            ? std::max(near - near_rows * null->sigma2[j], 0.) / share
            : uniform;
  }
}

// The largest variance of batch means over what independent rows would have:
// what a slowly changing weighting of the rows sees of the residual's spectrum
// (batch means: Law & Kelton). One row where all are independent.
double LongRun(const std::vector<double>& z, const std::vector<bool>& asked,
               double row_step) {
  double largest = 1;
  for (const double seconds : {.1, .25, .5, 1., 2.}) {
    const size_t length = std::max<size_t>(1, std::lround(seconds / row_step));
    double squares = 0;
    long batches = 0;
    for (size_t k = 0; k + length <= z.size(); k += length) {
      double sum = 0;
      bool whole = true;
      for (size_t i = k; i < k + length; ++i) {
        sum += z[i];
        whole = whole && asked[i];
      }
      if (!whole) continue;
      squares += sum * sum / length;
      ++batches;
    }
    if (batches >= 8) largest = std::max(largest, squares / batches);
  }
  return largest;
}

// Peaks of |z| above u, of those rows that are asked for, and their seconds.
// What is closer than the filter's memory is one peak.
struct Peaks {
  std::vector<double> heights;
  double seconds = 0;
};

Peaks PeaksAbove(double u, const std::vector<double>& z,
                 const std::vector<bool>& asked, double row_step,
                 double bandwidth_hz) {
  const long apart = std::lround(1 / (bandwidth_hz * row_step));
  Peaks peaks;
  double peak = 0;
  long below = 0;
  for (size_t k = 0; k < z.size(); ++k) {
    peaks.seconds += asked[k] ? row_step : 0;
    if (asked[k] && std::abs(z[k]) > u) {
      peak = std::max(peak, std::abs(z[k]));
      below = 0;
    } else if (++below >= apart && peak > 0) {
      peaks.heights.push_back(peak);
      peak = 0;
    }
  }
  if (peak > 0) peaks.heights.push_back(peak);
  return peaks;
}

// The level that the residual crosses `rate` times a second among the rows that
// are asked for. Above a high level u the heights of separate peaks are, of a
// Gaussian signal, such that (z^2 - u^2) / 2 is exponential of mean 1 (Rice's
// formula); heavier tails have a larger mean, which is learned from the peaks
// over u (peaks over a threshold: Davison & Smith 1990) and taken one standard
// error high. How far out the tail begins is not known: the highest of the
// levels counts that u at the 90, 95, 98 and 99 % quantiles give.
double TailLevel(const std::vector<double>& z, const std::vector<bool>& asked,
                 const NullOptions& options, double rate) {
  constexpr size_t kFewestPeaks = 6;
  std::vector<double> sorted;
  for (size_t k = 0; k < z.size(); ++k) {
    if (asked[k]) sorted.push_back(std::abs(z[k]));
  }
  std::sort(sorted.begin(), sorted.end());
  double level = RiceLevel(options.bandwidth_hz, rate);
  if (sorted.size() < kFewest) return level;
  for (const double quantile : {.9, .95, .98, .99}) {
    const double u = sorted[static_cast<size_t>(quantile * sorted.size())];
    const Peaks peaks =
        PeaksAbove(u, z, asked, options.row_step_s, options.bandwidth_hz);
    const double count = peaks.heights.size();
    if (count < kFewestPeaks) break;
    double mean = 0;
    for (const double height : peaks.heights) {
      mean += (height * height - u * u) / (2 * count);
    }
    mean = std::max(mean * (1 + 1 / std::sqrt(count)), 1.);
    const double decades = std::log(count / peaks.seconds / rate);
    level =
        std::max(level, std::sqrt(u * u + 2 * mean * std::max(decades, 0.)));
  }
  return level;
}

void LearnTails(const std::vector<WatchRow>& rows,
                const std::vector<VectorXd>& residuals,
                const ParameterBelief& belief, const NullOptions& options,
                NullModel* null) {
  const Eigen::Index n = null->sigma2.size(), p = belief.mean.size();
  std::vector<std::vector<double>> z(n), z_of_row(n);
  const MatrixXd root = CovarianceRoot(belief.covariance);
  for (size_t k = 0; k < rows.size(); ++k) {
    const VectorXd own = null->Variance(rows[k].crossing, rows[k].standing);
    const VectorXd all =
        own + (rows[k].A.leftCols(p) * root).rowwise().squaredNorm();
    for (int j = 0; j < n; ++j) {
      z[j].push_back(residuals[k][j] / std::sqrt(all[j]));
      z_of_row[j].push_back(residuals[k][j] / std::sqrt(own[j]));
    }
  }
  // Half of the false alarms are the contacts', each joint has its share.
  const double rate = options.false_alarms_per_hour / (2 * n * kSecondsPerHour);
  for (int j = 0; j < n; ++j) {
    // Residuals of rows that stand are small beside what they might be.
    std::vector<bool> far, near, moving;
    for (const WatchRow& row : rows) {
      moving.push_back(Stands(row.standing)[j] < kStanding);
      near.push_back(moving.back() && row.crossing[j] > kTouched);
      far.push_back(moving.back() && !near.back());
    }
    null->long_run[j] = LongRun(z_of_row[j], moving, options.row_step_s);
    const double independent =
        std::max<double>(std::count(moving.begin(), moving.end(), true), 1) /
        null->long_run[j];
    null->threshold[j] =
        StudentLevel(TailLevel(z[j], far, options, rate / 2), independent);
    null->crossing_threshold[j] = std::max(
        null->threshold[j],
        StudentLevel(TailLevel(z[j], near, options, rate / 2), independent));
  }
}

// Each hypothesis's parameters seem to change from window to window by more
// than noise explains: a model's error that comes and goes with the motion. The
// variance of that is a random effect's, by expectation and maximization
// (Laird & Ware 1982), taken two standard errors high.
MatrixXd LearnWander(const std::vector<WatchRow>& rows,
                     const std::vector<WatchHypothesis>& hypotheses,
                     const ParameterBelief& belief, const NullModel& null) {
  const Eigen::Index p = belief.mean.size();
  const MatrixXd root = CovarianceRoot(belief.covariance);
  std::vector<ChangeTest> windows;
  for (size_t k = 0; k < rows.size();) {
    RowInformation window(p + 6);
    const double end = rows[k].t + kWanderWindow;
    for (; k < rows.size() && rows[k].t < end; ++k) {
      window.Add(rows[k].A, rows[k].r, null.Weight(rows[k]));
    }
    windows.emplace_back(window, belief, root);
  }
  MatrixXd wander = MatrixXd::Zero(p, p);
  const double high = 1 + 2 * std::sqrt(2. / windows.size());
  for (WatchHypothesis change : hypotheses) {
    if (change.kind == WatchHypothesis::Kind::kContact) continue;
    VectorXd variance = change.stddev.cwiseAbs2();
    for (int step = 0; step < kWanderSteps; ++step) {
      change.stddev = variance.cwiseSqrt();
      variance.setZero();
      for (const ChangeTest& window : windows) {
        const ChangeEvidence evidence = window.Of(change);
        variance += evidence.theta.cwiseAbs2() + evidence.covariance.diagonal();
      }
      variance /= windows.size();
    }
    wander = WithChange(wander, change, high * variance);
  }
  return wander;
}

}  // namespace

double RiceLevel(double bandwidth_hz, double rate) {
  return std::sqrt(2 * std::log(std::max(2 * bandwidth_hz / rate, 1.)));
}

VectorXd NullModel::Variance(const VectorXd& crossing,
                             const VectorXd& standing) const {
  return sigma2 + crossing2.cwiseProduct(crossing) +
         standing2.cwiseProduct(Stands(standing));
}

VectorXd NullModel::Limit(const VectorXd& crossing,
                          const VectorXd& stddev) const {
  VectorXd limit = stddev;
  for (Eigen::Index j = 0; j < limit.size(); ++j) {
    limit[j] *= crossing[j] > kTouched ? crossing_threshold[j] : threshold[j];
  }
  return limit;
}

// What a joint that stands holds by friction is one unknown number, however
// many rows see it.
VectorXd NullModel::Weight(const WatchRow& row) const {
  const VectorXd moving = sigma2 + crossing2.cwiseProduct(row.crossing);
  return (moving.cwiseProduct(long_run) +
          standing_rows * standing2.cwiseProduct(Stands(row.standing)))
      .cwiseInverse();
}

// Shiryaev and Roberts: the sum of likelihood ratios (here Bayes factors, of
// mean 1 where nothing changes) over all times that a change may have begun at
// is a martingale but for its growth of 1 a test, so that the mean time to its
// first crossing of A is A tests at least (Pollak 1987). The largest of the
// ratios is smaller than the sum. `hypotheses` such sums share half of the
// false alarms.
NullModel LearnNull(const std::vector<WatchRow>& rows, const WatchModel& model,
                    const std::vector<WatchHypothesis>& hypotheses,
                    const NullOptions& options, ParameterBelief* belief) {
  const int n = model.num_joints();
  const Eigen::Index p = belief->mean.size();
  NullModel null;
  null.sigma2 = model.residual_rms.cwiseAbs2();
  null.crossing2 = null.standing2 = VectorXd::Zero(n);
  null.long_run = VectorXd::Ones(n);
  null.threshold = null.crossing_threshold = VectorXd::Zero(n);
  ParameterBelief free = *belief;
  for (const WatchHypothesis& change : hypotheses) {
    if (change.kind == WatchHypothesis::Kind::kContact) continue;
    free.covariance =
        WithChange(free.covariance, change, change.stddev.cwiseAbs2());
  }
  // Variances and estimate need each other; three rounds settle both.
  ParameterBelief learned;
  for (int round = 0; round < 3; ++round) {
    RowInformation all(p + 6);
    for (const WatchRow& row : rows) all.Add(row.A, row.r, null.Weight(row));
    learned = Updated(free, all);
    const auto residuals = Residuals(rows, learned.mean);
    LearnVariances(rows, residuals, model, &null);
    LearnTails(rows, residuals, learned, options, &null);
  }
  null.wander = LearnWander(rows, hypotheses, learned, null);
  null.standing_rows = kLongestWindow / options.row_step_s;
  // Twice a log Bayes factor is a square in standard deviations.
  const double level = std::sqrt(
      2 * std::log(hypotheses.size() * kTestsPerSecond * kSecondsPerHour /
                   (options.false_alarms_per_hour / 2)));
  const double student =
      StudentLevel(level, rows.size() / null.long_run.maxCoeff());
  null.log_bayes_threshold = student * student / 2;
  *belief = learned;
  return null;
}

}  // namespace armcal
