#include "calib/torque_bursts.h"

#include <algorithm>
#include <cmath>

#include "model/format.h"

namespace armcal {
namespace {

constexpr double kSecond = 1;
constexpr double kUsual = .9;  // of the seconds in which the joint moves
constexpr double kBeyond = 30;
constexpr double kFilterReach = 2;  // s

// Of each second: its first sample and a joint's rms torque.
struct Second {
  int begin;
  double rms;
  bool moves;
};

std::vector<Second> SecondsOf(const GapSegment& segment, int joint) {
  const int size =
      std::max(1, static_cast<int>(std::lround(kSecond / segment.motion.dt)));
  std::vector<Second> seconds;
  for (int k = 0; k < segment.size(); k += size) {
    const int rows = std::min(size, segment.size() - k);
    seconds.push_back(
        {k, segment.tau.col(joint).segment(k, rows).norm() / std::sqrt(rows),
         !segment.still.col(joint).segment(k, rows).all()});
  }
  return seconds;
}

double UsualOf(const std::vector<Second>& seconds) {
  std::vector<double> moving;
  for (const Second& second : seconds) {
    if (second.moves) moving.push_back(second.rms);
  }
  if (moving.empty()) return 0;
  const auto at =
      moving.begin() + static_cast<long>(kUsual * (moving.size() - 1));
  std::nth_element(moving.begin(), at, moving.end());
  return *at;
}

}  // namespace

std::vector<TorqueBurst> FindTorqueBursts(const GapSegment& segment) {
  std::vector<TorqueBurst> bursts;
  if (!segment.made_torque) return bursts;
  const Motion& motion = segment.motion;
  for (int j = 0; j < motion.num_joints(); ++j) {
    const std::vector<Second> seconds = SecondsOf(segment, j);
    const double usual = UsualOf(seconds);
    for (const Second& second : seconds) {
      if (usual == 0 || second.rms < kBeyond * usual) continue;
      const double begin = motion.time(second.begin);
      bursts.push_back({j, {begin, begin + kSecond}, second.rms, usual});
    }
  }
  return bursts;
}

std::vector<TimeRange> TimesOf(const std::vector<TorqueBurst>& bursts) {
  std::vector<TimeRange> times;
  for (const TorqueBurst& burst : bursts) {
    times.push_back(
        {burst.window.begin - kFilterReach, burst.window.end + kFilterReach});
  }
  return times;
}

std::vector<DataFinding> TellTorqueBursts(
    const Robot& robot, const std::vector<GapSegment>& segments) {
  std::vector<TorqueBurst> all;
  for (const GapSegment& segment : segments) {
    const std::vector<TorqueBurst> here = FindTorqueBursts(segment);
    all.insert(all.end(), here.begin(), here.end());
  }
  if (all.empty()) return {};
  const TorqueBurst& worst = *std::max_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.rms / a.usual < b.rms / b.usual;
      });
  const Joint& joint = robot.links[worst.joint].joint;
  const std::string evidence =
      Format("between %.0f and %.0f s ", worst.window.begin, worst.window.end) +
      joint.name +
      Format(
          " took %.3g %s, %.0f times its usual torque; such seconds are not "
          "judged by",
          worst.rms, EffortUnit(joint.type), worst.rms / worst.usual);
  return {{"the control loop was unstable for a moment", evidence,
           "lower gains, or a log without it"}};
}

}  // namespace armcal
