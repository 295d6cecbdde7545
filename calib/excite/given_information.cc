#include "calib/excite/given_information.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "problems/motion_information.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Its samples that count, by the stretch that they are in.
std::map<long, std::vector<int>> CountedSamples(const Trajectory& trajectory,
                                                double segment_s) {
  std::map<long, std::vector<int>> counted;
  for (int s = trajectory.core_begin; s < trajectory.core_end; ++s) {
    if (trajectory.standstill[s]) continue;
    counted[static_cast<long>(trajectory.time(s) / segment_s)].push_back(s);
  }
  return counted;
}

Motion MotionAt(const Trajectory& trajectory, const std::vector<int>& samples) {
  Motion motion;
  motion.dt = trajectory.dt;
  motion.q = trajectory.q(samples, Eigen::all);
  motion.qd = trajectory.qd(samples, Eigen::all);
  motion.qdd = trajectory.qdd(samples, Eigen::all);
  return motion;
}

}  // namespace

// The variance of a mean weighted by phi over a window of length L is the
// density times (2 / L) int phi^2 ds / (int phi ds)^2.
std::vector<SegmentInformation> InformationBySegment(
    const Robot& robot, const ModelParameters& model, const VectorXd& density,
    double segment_s, const Progress& progress, const PreparedLogs& logs) {
  MotionInformation information(robot, model);
  constexpr double kLeastShare = .1;  // a shorter rest is the one before's
  struct Sum {
    MatrixXd A;
    double seconds = 0;
  };
  std::map<std::pair<int, long>, Sum> sums;
  logs.ForEach(
      "what is known", progress, [&](int log, const Trajectory& trajectory) {
        for (const auto& [k, samples] : CountedSamples(trajectory, segment_s)) {
          const Motion motion = MotionAt(trajectory, samples);
          information.Evaluate(motion, motion.dt * density.cwiseInverse());
          Sum& sum = sums[{log, k}];
          if (sum.A.size() == 0) sum.A = 0 * information.A();
          sum.A += information.A();
          sum.seconds += motion.dt * motion.size();
        }
      });
  std::vector<SegmentInformation> segments;
  for (const auto& [key, sum] : sums) {
    const auto k = static_cast<double>(key.second);
    if (!segments.empty() && segments.back().log == key.first &&
        sum.seconds < kLeastShare * segment_s) {
      segments.back().range.end = (k + 1) * segment_s;
      segments.back().A += sum.A;
    } else {
      segments.push_back(
          {key.first, {k * segment_s, (k + 1) * segment_s}, sum.A});
    }
  }
  return segments;
}

MatrixXd GivenInformation(const Robot& robot, const ModelParameters& model,
                          const VectorXd& density, const Progress& progress,
                          const PreparedLogs& logs) {
  constexpr double kAll = 1e9;  // s
  MatrixXd A = MatrixXd::Zero(model.size(), model.size());
  for (const SegmentInformation& segment :
       InformationBySegment(robot, model, density, kAll, progress, logs)) {
    A += segment.A;
  }
  return A;
}

}  // namespace armcal
