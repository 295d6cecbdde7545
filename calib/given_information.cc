#include "calib/given_information.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "problems/motion_information.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of the weak form's test function (1 - s^2)^4: int phi^2 ds / (int phi ds)^2
// over [-1, 1], by Wallis' integrals 2 (2 4 .. 2 n) / (3 5 .. 2 n + 1).
double SquareOverMean() {
  const auto wallis = [](int n) {
    double value = 2;
    for (int k = 1; k <= n; ++k) value *= 2. * k / (2 * k + 1);
    return value;
  };
  return wallis(8) / (wallis(4) * wallis(4));
}

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
VectorXd ErrorDensity(const LinearCalibration& linear) {
  if (linear.rows.identification != Identification::kWeak) {
    return VectorXd::Constant(linear.noise.size(), std::nan(""));
  }
  return linear.noise.cwiseAbs2() *
         (linear.rows.window_s / (2 * SquareOverMean()));
}

std::vector<SegmentInformation> InformationBySegment(
    const Robot& robot, const ModelParameters& model, const VectorXd& density,
    double segment_s, const Progress& progress, LogSet* logs) {
  MotionInformation information(robot, model);
  constexpr double kLeastShare = .1;  // a shorter rest is the one before's
  struct Sum {
    MatrixXd A;
    double seconds = 0;
  };
  std::map<std::pair<int, long>, Sum> sums;
  logs->ForEach(
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
                          LogSet* logs) {
  constexpr double kAll = 1e9;  // s
  MatrixXd A = MatrixXd::Zero(model.size(), model.size());
  for (const SegmentInformation& segment :
       InformationBySegment(robot, model, density, kAll, progress, logs)) {
    A += segment.A;
  }
  return A;
}

}  // namespace armcal
