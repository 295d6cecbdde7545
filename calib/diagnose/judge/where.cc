#include "calib/diagnose/judge/where.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBins = 10;

// Sum over bins of (mean)^2 n, of y in the order of x.
double ChiSquaredOfBins(const VectorXd& x, const VectorXd& y) {
  std::vector<int> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return x[a] < x[b]; });
  double chi_squared = 0;
  const size_t size = order.size();
  for (int bin = 0; bin < kBins; ++bin) {
    const size_t begin = size * bin / kBins, end = size * (bin + 1) / kBins;
    double sum = 0;
    for (size_t k = begin; k < end; ++k) sum += y[order[k]];
    if (end > begin)
      chi_squared += sum * sum / static_cast<double>(end - begin);
  }
  return chi_squared;
}

}  // namespace

JointCourse JointCourseOf(const GapFit& fit, int j) {
  const GapRows& rows = fit.rows();
  std::vector<MatrixXd> fine;
  for (size_t s = 0; s < rows.segments().size(); ++s) {
    const Motion& motion = rows.segments()[s].motion;
    fine.emplace_back(motion.size(), 5);
    fine.back() << motion.q.col(j), motion.qd.col(j), motion.qdd.col(j),
        fit.data()->torques()[s].load().col(j),
        VectorXd::LinSpaced(motion.size(), motion.time(0),
                            motion.time(motion.size() - 1));
  }
  const MatrixXd at = rows.PickAll(fine)(rows.SampleOfRow(j), Eigen::all);
  return {fit.screen().Residual(j, {}),
          at.col(0),
          at.col(1),
          at.col(2),
          at.col(3),
          at.col(4)};
}

// Residuals are ordered by a coordinate where means over its quantiles are not
// zero:
//   chi^2 = sum over bins of (mean of r)^2 n,
// of kBins bins with as many samples each, chi squared of 10 degrees where they
// are white. Friction shows along the speed as r times the direction of motion,
// since a law that is odd in velocity has a mean of 0 over bins of |velocity|.
// The coordinate with the largest excess over Limits().order (99.9 %, seven
// coordinates) names it; a residual louder than its noise is divided by its rms
// first, lest every coordinate order it.
Organisation OrganisedBy(const JointCourse& course) {
  Organisation best;
  if (course.residual.size() < 5 * kBins) return best;
  // Louder than the noise it was told is not ordered.
  const double rms = std::sqrt(course.residual.squaredNorm() /
                               static_cast<double>(course.residual.size()));
  const VectorXd r = course.residual / std::max(1., rms);
  const VectorXd direction = course.velocity.cwiseSign();
  const VectorXd against = r.cwiseProduct(direction);
  struct Coordinate {
    const char* name;
    VectorXd x;
    const VectorXd& y;
  };
  const std::vector<Coordinate> coordinates = {
      {"velocity", course.velocity, r},
      {"speed", course.velocity.cwiseAbs(), against},
      {"position", course.position, r},
      {"acceleration", course.acceleration, r},
      {"load", course.load, r},
      {"load and direction", course.load.cwiseAbs(), against},
      {"time", course.time, r}};
  for (const Coordinate& coordinate : coordinates) {
    const double excess =
        ChiSquaredOfBins(coordinate.x, coordinate.y) - Limits().order;
    if (excess > best.excess) best = {coordinate.name, excess};
  }
  return best;
}

}  // namespace armcal
