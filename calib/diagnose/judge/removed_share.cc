#include "calib/diagnose/judge/removed_share.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "calib/numerics/block_bootstrap.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// 100 (from - after) / (from - floor): of what is beyond the noise, how much is
// removed. NaN where there is no more than `least` beyond it, since a ratio of
// two noises says nothing.
double Removed(double from, double after, double floor, double least = 0) {
  return from > floor + least ? 100 * (from - after) / (from - floor)
                              : std::numeric_limits<double>::quiet_NaN();
}

VectorXd RmsOfJoints(const MatrixXd& squares) {
  VectorXd rms(squares.cols());
  for (int j = 0; j < squares.cols(); ++j) {
    const SumsOverJoints one = SumJoints(squares.col(j));
    rms[j] = one.count.sum() > 0 ? std::sqrt(one.sum.sum() / one.count.sum())
                                 : std::numeric_limits<double>::quiet_NaN();
  }
  return rms;
}

// No model leaves less than the noise: a floor above what is left was told too
// high, and the part above belongs below.
double BelowWhatIsLeft(double floor, double left) {
  return floor > left ? std::max(0., 2 * left - floor) : floor;
}

// The 95 % interval of what is removed between two of them, by a bootstrap of
// blocks over time (block_bootstrap.h), their length told by the correlation
// time of the gain: samples of one log are not independent, blocks of it nearly
// are. Each draw has a floor of its own, normal about it with `floor_stddev`,
// so that the interval holds how well the noise is known. Where that floor is
// what is left, draws of it lie below, and the point estimate closes the
// interval.
void SetInterval(const SumsOverJoints& from, const SumsOverJoints& after,
                 double floor, double floor_stddev, std::uint64_t seed,
                 double removed, double* ci95) {
  const int size = static_cast<int>(from.sum.size());
  std::vector<double> gain(size);
  for (int k = 0; k < size; ++k) gain[k] = from.sum[k] - after.sum[k];
  std::mt19937_64 random(seed);
  std::normal_distribution<double> deviation;
  const BootstrapInterval interval =
      BlockBootstrap(size, BootstrapBlock(size, CorrelationTime(gain)), seed,
                     [&](const std::vector<int>& drawn) {
                       double before = 0, left = 0, all = 0;
                       for (const int k : drawn) {
                         before += from.sum[k];
                         left += after.sum[k];
                         all += from.count[k];
                       }
                       const double drawn_floor =
                           floor * (1 + floor_stddev * deviation(random));
                       return Removed(before / all, left / all,
                                      BelowWhatIsLeft(drawn_floor, left / all));
                     });
  ci95[0] = interval.low;
  // Where the floor is what is left, draws of it lie below.
  ci95[1] = removed > interval.high ? removed : interval.high;
}

}  // namespace

SumsOverJoints SumJoints(const MatrixXd& squares) {
  SumsOverJoints series{VectorXd::Zero(squares.rows()),
                        VectorXd::Zero(squares.rows())};
  for (int j = 0; j < squares.cols(); ++j) {
    for (int k = 0; k < squares.rows(); ++k) {
      if (std::isnan(squares(k, j))) continue;
      series.sum[k] += squares(k, j);
      series.count[k] += 1;
    }
  }
  return series;
}

double MeanSquare(const MatrixXd& squares) {
  const SumsOverJoints series = SumJoints(squares);
  const double count = series.count.sum();
  return count > 0 ? series.sum.sum() / count : 1;
}

// Means over all samples and joints of squares in units of the noise's
// variance: of the robot as its file has it, of a refit, and with the effects.
// The floor is 1, the noise itself, or what is left where that is less. Shares
// are of the refit's gap, not the file's: what fitting numbers alone explains
// is no effect's.
GapFigures RemovedShareFigures(const HeldOutSquares& squares,
                               double floor_stddev, std::uint64_t seed) {
  GapFigures figures;
  const SumsOverJoints nominal = SumJoints(squares.nominal);
  const SumsOverJoints refit = SumJoints(squares.refit);
  const SumsOverJoints after = SumJoints(squares.after);
  const double count = refit.count.sum();
  if (!(count > 0)) return figures;
  figures.nominal = nominal.sum.sum() / count;
  figures.refit = refit.sum.sum() / count;
  figures.after = after.sum.sum() / count;
  figures.floor = std::min(1., figures.after);
  figures.removed_percent =
      Removed(figures.refit, figures.after, figures.floor, floor_stddev);
  figures.removed_from_nominal_percent =
      Removed(figures.nominal, figures.after, figures.floor, floor_stddev);
  figures.refit_removes_percent =
      Removed(figures.nominal, figures.refit, figures.floor, floor_stddev);
  figures.joints.resize(squares.refit.cols(), 3);
  figures.joints << RmsOfJoints(squares.nominal), RmsOfJoints(squares.refit),
      RmsOfJoints(squares.after);
  SetInterval(refit, after, figures.floor, floor_stddev, seed,
              figures.removed_percent, figures.ci95);
  SetInterval(nominal, after, figures.floor, floor_stddev, seed,
              figures.removed_from_nominal_percent, figures.nominal_ci95);
  return figures;
}

}  // namespace armcal
