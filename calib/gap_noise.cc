#include "calib/gap_noise.h"

#include <cmath>
#include <optional>

#include "calib/repeated_motion.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLeastRows = 60;

int CountRows(const std::vector<VectorXd>& stretches) {
  int rows = 0;
  for (const VectorXd& x : stretches) rows += static_cast<int>(x.size());
  return rows;
}

// Of one joint, what differs from one repeat to the next, over root 2.
std::vector<VectorXd> RepeatDifferences(const GapRows& rows, int joint,
                                        const VectorXd& residual,
                                        const std::vector<int>& lags) {
  std::vector<VectorXd> stretches;
  for (const GapRows::Run& run : rows.runs(joint)) {
    const int lag = lags[run.segment];
    if (lag == 0 || run.size <= lag) continue;
    stretches.push_back((residual.segment(run.begin + lag, run.size - lag) -
                         residual.segment(run.begin, run.size - lag)) /
                        std::sqrt(2));
  }
  return stretches;
}

std::vector<VectorXd> Stretches(const std::vector<GapRows::Run>& runs,
                                const VectorXd& residual) {
  std::vector<VectorXd> stretches;
  for (const GapRows::Run& run : runs) {
    stretches.push_back(residual.segment(run.begin, run.size));
  }
  return stretches;
}

}  // namespace

const char* NoiseFloorName(NoiseFloor source) {
  switch (source) {
    case NoiseFloor::kRepeats:
      return "repeats";
    case NoiseFloor::kStandstill:
      return "standstill";
    case NoiseFloor::kAssumed:
      return "assumed";
  }
  return "";
}

int RepeatLag(const GapRows& rows, int segment) {
  const Motion& motion = rows.segments()[segment].motion;
  RecordedMotion recorded;
  recorded.q = rows.Pick(segment, motion.q);
  recorded.t.resize(recorded.q.rows());
  for (int k = 0; k < recorded.t.size(); ++k) {
    recorded.t[k] = k * rows.step(segment);
  }
  constexpr double kShortestPeriod = 2;  // s
  const auto lag = FindRepeat(recorded, recorded, kShortestPeriod);
  return lag ? static_cast<int>(std::lround(*lag / rows.step(segment))) : 0;
}

GapNoise EstimateGapNoise(const GapRows& rows, const MatrixXd& residual,
                          const MatrixXd& assumed) {
  const int n = rows.num_joints();
  std::vector<int> lags;
  for (size_t s = 0; s < rows.segments().size(); ++s) {
    lags.push_back(RepeatLag(rows, static_cast<int>(s)));
  }
  GapNoise noise;
  noise.source = NoiseFloor::kRepeats;
  for (int j = 0; j < n; ++j) {
    const auto repeats = RepeatDifferences(rows, j, residual.col(j), lags);
    if (CountRows(repeats) >= kLeastRows) {
      noise.joints.push_back(FitAutoregression(repeats, false));
      continue;
    }
    const auto still = Stretches(rows.still_runs(j), residual.col(j));
    if (CountRows(still) >= kLeastRows) {
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

}  // namespace armcal
