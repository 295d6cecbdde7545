#include "calib/diagnose/data/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calib/diagnose/data/thresholds.h"
#include "calib/logs/repeated_motion.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

int CountRows(const std::vector<VectorXd>& stretches) {
  int rows = 0;
  for (const VectorXd& x : stretches) rows += static_cast<int>(x.size());
  return rows;
}

// Lag of the motion's repeats in fine samples; 0: none. A log begins and ends
// with what does not repeat: a rest, and a start or a stop, which is a motion
// from or into a posture and as long as the shortest that may repeat.
int RepeatLag(const GapSegment& segment) {
  const Motion& motion = segment.motion;
  int begin = 0, end = motion.size();
  while (begin < end && segment.still.row(begin).all()) ++begin;
  while (begin < end && segment.still.row(end - 1).all()) --end;
  const int start = static_cast<int>(Limits().shortest_period / motion.dt);
  const int size = end - begin - 2 * start;
  if (size < 1) return 0;
  const RecordedMotion recorded{
      VectorXd::LinSpaced(size, 0, (size - 1) * motion.dt),
      motion.q.middleRows(begin + start, size)};
  const auto lag = FindRepeat(recorded, recorded, Limits().shortest_period);
  return lag ? static_cast<int>(std::lround(*lag / motion.dt)) : 0;
}

// Whether the motion at each sample is that of `lag` samples later: positions
// to repeat_tolerance of their usual size and velocities to three times as
// much, joints all together. Half a milliradian and 5 mrad/s are added, which
// encoders have.
std::vector<bool> Repeats(const Motion& motion, int lag) {
  const auto usual = [](const MatrixXd& x) -> Eigen::RowVectorXd {
    return (x.colwise().squaredNorm() / x.rows()).cwiseSqrt();
  };
  const Eigen::RowVectorXd q =
      Limits().repeat_tolerance *
      usual(motion.q.rowwise() - motion.q.colwise().mean());
  const Eigen::RowVectorXd qd =
      3 * Limits().repeat_tolerance * usual(motion.qd);
  std::vector<bool> repeats(motion.size(), false);
  for (int k = 0; k + lag < motion.size(); ++k) {
    repeats[k] = ((motion.q.row(k + lag) - motion.q.row(k)).array().abs() <
                  q.array() + 5e-4)
                     .all() &&
                 ((motion.qd.row(k + lag) - motion.qd.row(k)).array().abs() <
                  qd.array() + 5e-3)
                     .all();
  }
  return repeats;
}

// What differs from one repeat of a motion to the next, over root 2 so that it
// has the noise's variance: everything that a model lacks is in both and falls
// out, whatever it is (a residual of any model does). Thinned, all segments;
// samples that have no repeat are NaN.
MatrixXd RepeatDifferences(const GapRows& rows,
                           const std::vector<MatrixXd>& residual) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  MatrixXd all = MatrixXd::Constant(rows.num_thin(), rows.num_joints(), kNone);
  for (size_t i = 0; i < residual.size(); ++i) {
    const int s = static_cast<int>(i);
    const Motion& motion = rows.segments()[i].motion;
    const int lag = RepeatLag(rows.segments()[i]);
    if (lag == 0) continue;
    const int size = motion.size() - lag;
    MatrixXd fine = MatrixXd::Zero(motion.size(), motion.num_joints());
    fine.topRows(size) =
        (residual[i].bottomRows(size) - residual[i].topRows(size)) /
        std::sqrt(2);
    MatrixXd known(motion.size(), 1);
    const std::vector<bool> repeats = Repeats(motion, lag);
    for (int k = 0; k < motion.size(); ++k) known(k, 0) = repeats[k];
    const MatrixXd thin = rows.Thin(s, fine), pick = rows.Pick(s, known);
    for (int k = 0; k < thin.rows(); ++k) {
      if (pick(k, 0) > 0) all.row(rows.thin_begin(s) + k) = thin.row(k);
    }
  }
  return all;
}

std::vector<VectorXd> Stretches(const std::vector<GapRows::Run>& runs,
                                const VectorXd& residual) {
  std::vector<VectorXd> stretches;
  for (const GapRows::Run& run : runs) {
    stretches.push_back(residual.segment(run.begin, run.size));
  }
  return stretches;
}

// The parts of stretches that are known.
std::vector<VectorXd> Known(const std::vector<VectorXd>& stretches) {
  std::vector<VectorXd> parts;
  for (const VectorXd& x : stretches) {
    for (int begin = 0, k = 0; k <= x.size(); ++k) {
      if (k < x.size() && !std::isnan(x[k])) continue;
      if (k > begin + Autoregression::kOrder) {
        parts.push_back(x.segment(begin, k - begin));
      }
      begin = k + 1;
    }
  }
  return parts;
}

}  // namespace

double ExtraVariance(NoiseFloor source) {
  switch (source) {
    case NoiseFloor::kRepeats:
    case NoiseFloor::kReference:
    case NoiseFloor::kPositions:
      return Limits().extra_variance_of_noise;
    case NoiseFloor::kStandstill:
    case NoiseFloor::kAssumed:
      break;
  }
  return Limits().extra_variance_of_others;
}

const char* NoiseFloorName(NoiseFloor source) {
  switch (source) {
    case NoiseFloor::kRepeats:
      return "repeats";
    case NoiseFloor::kStandstill:
      return "standstill";
    case NoiseFloor::kReference:
      return "reference";
    case NoiseFloor::kPositions:
      return "positions";
    case NoiseFloor::kAssumed:
      return "assumed";
  }
  return "";
}

// The sources in the order of how much they can be trusted: repeats, which hold
// none of what the model lacks; standstill, whose noise lacks what motion adds;
// and a refit's residual, which holds everything. Each joint takes the best
// that has noise_rows of it, and the source told is the worst of the joints'
// sources, since that is what claims of all of them are worth.
GapNoise EstimateGapNoise(const GapRows& rows,
                          const std::vector<MatrixXd>& residual,
                          const MatrixXd& assumed) {
  const int n = rows.num_joints();
  MatrixXd differences = RepeatDifferences(rows, residual);
  const MatrixXd thin = rows.ThinAll(residual);
  GapNoise noise;
  noise.source = NoiseFloor::kRepeats;
  for (int j = 0; j < n; ++j) {
    differences.col(j) = rows.WithoutDrift(j, differences.col(j));
    const auto repeats = Known(Stretches(rows.runs(j), differences.col(j)));
    if (CountRows(repeats) >= Limits().noise_rows) {
      noise.joints.push_back(FitAutoregression(repeats, false));
      continue;
    }
    const auto still = Stretches(rows.still_runs(j), thin.col(j));
    if (CountRows(still) >= Limits().noise_rows) {
      noise.joints.push_back(FitAutoregression(still, true));
      noise.source = std::max(noise.source, NoiseFloor::kStandstill);
      continue;
    }
    noise.joints.push_back(
        FitAutoregression(Stretches(rows.runs(j), assumed.col(j)), false));
    noise.source = NoiseFloor::kAssumed;
  }
  return noise;
}

GapNoise ResidualNoise(const GapRows& rows, const MatrixXd& residual) {
  GapNoise noise;
  noise.source = NoiseFloor::kReference;
  for (int j = 0; j < rows.num_joints(); ++j) {
    noise.joints.push_back(
        FitAutoregression(Stretches(rows.runs(j), residual.col(j)), false));
  }
  return noise;
}

}  // namespace armcal
