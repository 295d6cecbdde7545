#include "calib/diagnose/data/torque_bursts.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/rows.h"
#include "calib/diagnose/data/thresholds.h"
#include "model/signals/low_pass.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSecond = 1;

// Of each second: its first sample and rms of a joint's torque.
struct Second {
  int begin;
  double rms, fast;
  bool moves;
};

std::vector<Second> SecondsOf(const GapSegment& segment, const VectorXd& fast,
                              int joint) {
  const int size =
      std::max(1, static_cast<int>(std::lround(kSecond / segment.motion.dt)));
  std::vector<Second> seconds;
  for (int k = 0; k < segment.size(); k += size) {
    const int rows = std::min(size, segment.size() - k);
    const auto rms = [&](const VectorXd& x) {
      return x.segment(k, rows).norm() / std::sqrt(rows);
    };
    seconds.push_back({k, rms(segment.tau.col(joint)), rms(fast),
                       !segment.still.col(joint).segment(k, rows).all()});
  }
  return seconds;
}

// Of the seconds in which the joint moves.
double Middle(const std::vector<Second>& seconds, double Second::*value) {
  std::vector<double> moving;
  for (const Second& second : seconds) {
    if (second.moves) moving.push_back(second.*value);
  }
  if (moving.empty()) return 0;
  const auto middle = moving.begin() + static_cast<long>(moving.size() / 2);
  std::nth_element(moving.begin(), middle, moving.end());
  return *middle;
}

}  // namespace

// A loop that rings, or lost its stability for a moment, has torque above the
// bandwidth which the motion does not ask for. Second by second, joint by
// joint, that torque is compared with what is usual for the joint
// (Limits().burst) and with what its own seconds usually have up there: a joint
// that always swings is its own measure. The rms of its middle second is the
// standard deviation of that, which a second is clear of among as many as a log
// has beyond Limits().clear_of_many of them.
std::vector<TorqueBurst> FindTorqueBursts(const GapSegment& segment,
                                          double bandwidth_hz) {
  std::vector<TorqueBurst> bursts;
  if (!segment.reconstructed_torque || bandwidth_hz <= 0) return bursts;
  const Motion& motion = segment.motion;
  const MatrixXd fast =
      segment.tau - ZeroPhaseLowPass(segment.tau, 1 / motion.dt, bandwidth_hz);
  for (int j = 0; j < motion.num_joints(); ++j) {
    const std::vector<Second> seconds = SecondsOf(segment, fast.col(j), j);
    const double usual = Middle(seconds, &Second::rms);
    const double least =
        std::max(Limits().burst * usual,
                 Limits().clear_of_many * Middle(seconds, &Second::fast));
    for (const Second& second : seconds) {
      if (usual == 0 || second.fast < least) continue;
      const double begin = motion.time(second.begin);
      bursts.push_back({j, {begin, begin + kSecond}, second.fast, usual});
    }
  }
  return bursts;
}

std::vector<TimeRange> TimesOf(const std::vector<TorqueBurst>& bursts,
                               double bandwidth_hz) {
  const double reach = GapRows::kPeriodsAtEnds / bandwidth_hz;
  std::vector<TimeRange> times;
  for (const TorqueBurst& burst : bursts) {
    times.push_back({burst.window.begin - reach, burst.window.end + reach});
  }
  return times;
}

// What a report says of them: the joint and the second that stand out most from
// the joint's usual torque, in words that name what was not judged by.
std::vector<DataFinding> TellTorqueBursts(
    const Robot& robot, const std::vector<GapSegment>& segments,
    double bandwidth_hz) {
  std::vector<TorqueBurst> all;
  for (const GapSegment& segment : segments) {
    const std::vector<TorqueBurst> here =
        FindTorqueBursts(segment, bandwidth_hz);
    all.insert(all.end(), here.begin(), here.end());
  }
  if (all.empty()) return {};
  const TorqueBurst& worst = *std::max_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.fast / a.usual < b.fast / b.usual;
      });
  const Joint& joint = robot.links[worst.joint].joint;
  const std::string evidence =
      Format("between %.0f and %.0f s ", worst.window.begin, worst.window.end) +
      joint.name +
      Format(
          " swung with %.3g %s above %.3g Hz, %.3g times its usual torque; "
          "such "
          "seconds are not judged by",
          worst.fast, EffortUnit(joint.type), bandwidth_hz,
          worst.fast / worst.usual);
  return {{"the control loop rang or was unstable for a moment", evidence,
           "lower gains, or a log without it"}};
}

}  // namespace armcal
