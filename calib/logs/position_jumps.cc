#include "calib/logs/position_jumps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "calib/numerics/median.h"
#include "model/robot/axis_rotation.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kMotionSpeed = .02;  // rad/s or m/s
constexpr int kSlopeReach = 3;        // rows of a slope to both sides
// Times the speed below which nine tenths of the motion are. Sines of several
// frequencies reach 2 to 3 times that, and clocks that skip a row twice it.
constexpr double kFaster = 5;
constexpr double kAround = 5;  // times the smaller one of the steps around
// Of the usual step, which is noise where a joint rests, and of the finest one,
// which is the encoder's resolution.
constexpr double kUsualSteps = 10;
// Times its steps around that a joint goes in a step that misses a row and
// more; one that starts or stops goes less.
constexpr double kAhead = 2.5;
constexpr double kMostJumps = .05;  // of all steps
constexpr double kSpike = .1;       // s, the longest
constexpr double kBack = .2;        // of its size, to which a spike comes back
constexpr double kOfATurn = .1;  // by which a turn may be off: motion goes on

struct RowSteps {
  VectorXd size;   // q of a row less that of the row before, per step
  VectorXd speed;  // of a step, since the position last changed
};

// A position that was held for some rows makes up for them in one step.
RowSteps RowStepsOf(const VectorXd& t, const VectorXd& q, double usual) {
  RowSteps steps;
  steps.size = q.tail(q.size() - 1) - q.head(q.size() - 1);
  steps.speed.resize(steps.size.size());
  double since = t[0];
  for (Eigen::Index k = 0; k < steps.size.size(); ++k) {
    steps.speed[k] =
        std::abs(steps.size[k]) / std::max(t[k + 1] - since, usual);
    if (steps.size[k] != 0) since = t[k + 1];
  }
  return steps;
}

// Below which nine tenths of the motion are; of a joint that hardly moves the
// speed from which on it would.
double UsualSpeed(const VectorXd& t, const VectorXd& q) {
  std::vector<double> moving;
  for (Eigen::Index k = kSlopeReach; k + kSlopeReach < q.size(); ++k) {
    const double time = t[k + kSlopeReach] - t[k - kSlopeReach];
    if (!(time > 0)) continue;
    const double speed =
        std::abs(q[k + kSlopeReach] - q[k - kSlopeReach]) / time;
    if (speed > kMotionSpeed) moving.push_back(speed);
  }
  return moving.empty() ? kMotionSpeed : Quantile(moving, .9);
}

double LeastStep(const VectorXd& size) {
  std::vector<double> steps;
  double finest = std::numeric_limits<double>::infinity();
  for (const double step : size) {
    steps.push_back(std::abs(step));
    if (step != 0) finest = std::min(finest, std::abs(step));
  }
  if (!std::isfinite(finest)) return finest;
  return kUsualSteps * std::max(Median(steps), finest);
}

// RowSteps that are none of the motion.
std::vector<int> Jumps(const RowSteps& steps, double usual_speed) {
  const Eigen::Index count = steps.size.size();
  const double least = LeastStep(steps.size);
  std::vector<int> jumps;
  for (Eigen::Index k = 1; k + 1 < count; ++k) {
    const double size = std::abs(steps.size[k]);
    const double around =
        std::min(std::abs(steps.size[k - 1]), std::abs(steps.size[k + 1]));
    if (size > least && steps.speed[k] > kFaster * usual_speed &&
        size > kAround * around) {
      jumps.push_back(static_cast<int>(k));
    }
  }
  if (static_cast<double>(jumps.size()) >
      kMostJumps * static_cast<double>(count)) {
    jumps.clear();
  }
  return jumps;
}

// The whole turns in a step, in rad, or in degrees where it is that large; 0
// where it is none.
double WholeTurns(double size) {
  constexpr double kDegrees = 50;  // more rad than an arm goes in a step
  const double turn = std::abs(size) > kDegrees ? 360 : 2 * M_PI;
  const double turns = turn * std::round(size / turn);
  return std::abs(size - turns) < kOfATurn * turn ? turns : 0;
}

// Whether a joint that moves goes ahead of itself in a step, by what its steps
// around are.
bool IsAhead(const RowSteps& steps, Eigen::Index k, double usual) {
  double around = 0;
  int count = 0;
  for (const Eigen::Index near : {k - 2, k - 1, k + 1, k + 2}) {
    if (near < 0 || near >= steps.size.size()) continue;
    around += std::abs(steps.size[near]);
    ++count;
  }
  around /= std::max(1, count);
  return around > kMotionSpeed * usual &&
         std::abs(steps.size[k]) > kAhead * around;
}

// Turns, what comes back, and the rest.
PositionJumps Sorted(const VectorXd& t, const VectorXd& q,
                     const std::vector<int>& jumps, double speed, bool turns) {
  PositionJumps found;
  for (size_t i = 0; i < jumps.size(); ++i) {
    const int k = jumps[i];
    const double size = q[k + 1] - q[k];
    if (turns && WholeTurns(size) != 0) {
      found.wraps.push_back({k + 1, size});
      continue;
    }
    size_t back = i + 1;
    while (back < jumps.size() && t[jumps[back]] - t[k] <= kSpike &&
           std::abs(q[jumps[back] + 1] - q[k]) >
               kBack * std::abs(size) + speed * (t[jumps[back] + 1] - t[k])) {
      ++back;
    }
    if (back < jumps.size() && t[jumps[back]] - t[k] <= kSpike) {
      found.spikes.push_back({k + 1, jumps[back] + 1, size});
      i = back;
    } else {
      found.steps.push_back({k + 1, size});
    }
  }
  return found;
}

}  // namespace

LogJumps FindPositionJumps(const Robot& robot, const Log& log) {
  const int n = robot.num_joints();
  LogJumps found;
  found.joints.resize(n);
  if (log.size() <= 2 * kSlopeReach) return found;
  const VectorXd t = log.t;
  std::vector<double> intervals;
  for (int k = 0; k + 1 < log.size(); ++k) {
    intervals.push_back(t[k + 1] - t[k]);
  }
  const double usual = Median(intervals);
  std::vector<RowSteps> steps;
  for (int j = 0; j < n; ++j) {
    steps.push_back(RowStepsOf(t, log.q.col(j), usual));
  }
  std::set<int> missing;
  for (int j = 0; j < n; ++j) {
    const VectorXd q = log.q.col(j);
    const double speed = UsualSpeed(t, q);
    std::vector<int> alone;
    for (const int k : Jumps(steps[j], speed)) {
      bool common = false;
      for (int other = 0; other < n; ++other) {
        common |= other != j && IsAhead(steps[other], k, usual);
      }
      if (common) {
        missing.insert(k + 1);
      } else {
        alone.push_back(k);
      }
    }
    found.joints[j] =
        Sorted(t, q, alone, speed, IsRotational(robot.links[j].joint.type));
  }
  found.missing_time.assign(missing.begin(), missing.end());
  return found;
}

void MendJumps(const std::vector<PositionJumps>& jumps, Log* log) {
  for (size_t j = 0; j < jumps.size(); ++j) {
    auto q = log->q.col(static_cast<Eigen::Index>(j));
    for (const PositionJumps::Rows& rows : jumps[j].spikes) {
      const double before = q[rows.begin - 1], after = q[rows.end];
      const double t0 = log->t[rows.begin - 1];
      const double time = log->t[rows.end] - t0;
      for (int k = rows.begin; k < rows.end; ++k) {
        const double share = time > 0 ? (log->t[k] - t0) / time : .5;
        q[k] = before + share * (after - before);
      }
    }
    for (const PositionJumps::Step& wrap : jumps[j].wraps) {
      q.tail(q.size() - wrap.row).array() -= WholeTurns(wrap.size);
    }
  }
}

}  // namespace armcal
