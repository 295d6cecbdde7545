#include "calib/inspect/stuck_positions.h"

#include <algorithm>
#include <cmath>

#include "calib/inspect/equal_rows.h"
#include "calib/inspect/frozen_findings.h"
#include "calib/inspect/inspected_series.h"
#include "model/log_files/row_range.h"
#include "model/signals/position_spikes.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kNatsAgainstChance = 15;  // as of FindFrozenChannels
constexpr double kShortestStuck = .1;      // s; what is shorter may be a spike
constexpr double kSlowestGoing = .02;      // rad/s or m/s, as of stuck columns
// Times the speed of a joint's motion and times the step after it, as FindJumps
// has both.
constexpr double kFasterStep = 5;

// Whether the step to row k is none of the joint's motion, if it took the time
// of one row.
bool IsJump(const VectorXd& t, const VectorXd& q, const PositionSteps& steps,
            int k) {
  const double size = std::abs(q[k] - q[k - 1]);
  const double time = std::max(t[k] - t[k - 1], steps.usual_interval);
  const double after =
      k + 1 < q.size() ? std::abs(q[k + 1] - q[k]) : steps.usual_speed * time;
  return size > steps.least && size > kFasterStep * steps.usual_speed * time &&
         size > kFasterStep * after;
}

// Runs of one number, single rows as well, that end in a step of motion: a
// joint that starts from rest goes on by less.
std::vector<EqualRows> RunsInMotion(const VectorXd& t, const VectorXd& q) {
  std::vector<EqualRows> runs =
      RunsOfEqualRows(q, std::vector<bool>(q.size(), true));
  const auto rests = [&](const EqualRows& run) {
    if (run.end >= q.size()) return true;
    const double time = t[run.end] - t[run.begin];
    return std::abs(q[run.end] - q[run.begin]) <= kSlowestGoing * time;
  };
  runs.erase(std::remove_if(runs.begin(), runs.end(), rests), runs.end());
  return runs;
}

// Whether a joint goes faster than one that rests for kShortestStuck from row
// `row` on, by `way`: 1 or, into the past, -1. One that turns round meanwhile
// has gone on the way.
bool MovesFrom(const VectorXd& t, const VectorXd& q, Eigen::Index row,
               int way) {
  double gone = 0;
  for (Eigen::Index k = row; k >= 0 && k < q.size(); k += way) {
    if (std::abs(t[k] - t[row]) > kShortestStuck) break;
    gone = std::max(gone, std::abs(q[k] - q[row]));
  }
  return gone > kSlowestGoing * kShortestStuck;
}

// The speed from a row to the third one from it; 0 at the ends of a log.
double SpeedAt(const VectorXd& t, const VectorXd& q, Eigen::Index row,
               int way) {
  const Eigen::Index to = row + 3 * way;
  if (to < 0 || to >= q.size() || t[to] == t[row]) return 0;
  return std::abs((q[to] - q[row]) / (t[to] - t[row]));
}

// Whether the step after rows of one number is of the joint's zero, and not of
// the way that it has gone meanwhile. It is where the joint rests before or
// after, and the step is farther than it would come at the speed that it had
// before or has after: coming to rest, or starting, it would go less far.
bool IsOfZero(const VectorXd& t, const VectorXd& q, const EqualRows& run) {
  if (MovesFrom(t, q, run.begin, -1) && MovesFrom(t, q, run.end, 1)) {
    return false;
  }
  const double fastest =
      std::max(SpeedAt(t, q, run.begin, -1), SpeedAt(t, q, run.end, 1));
  return std::abs(q[run.end] - q[run.begin]) >
         fastest * (t[run.end] - t[run.begin]);
}

// Rows of one number that end in a jump: of the joint's zero, or not.
std::vector<FrozenChannel> RunsThatJump(const Robot& robot, const Log& log,
                                        bool of_zero) {
  std::vector<PositionSteps> steps;
  for (int j = 0; j < robot.num_joints(); ++j) {
    steps.push_back(FindJumps(log.t, log.q.col(j)));
  }
  std::vector<FrozenChannel> stuck;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const VectorXd q = log.q.col(j);
    std::vector<FrozenChannel> of_joint;
    for (const EqualRows& run :
         TooLongForChance(RunsInMotion(log.t, q), kNatsAgainstChance)) {
      if (log.t[run.end - 1] - log.t[run.begin] < kShortestStuck ||
          !IsJump(log.t, q, steps[j], run.end)) {
        continue;
      }
      bool alone = true;
      for (int other = 0; other < robot.num_joints(); ++other) {
        alone = alone && (other == j || !IsJump(log.t, log.q.col(other),
                                                steps[other], run.end));
      }
      if (!alone || IsOfZero(log.t, q, run) != of_zero) continue;
      of_joint.push_back({j, true, run.begin, run.end, q[run.begin], 0, 0, 0,
                          q[run.end] - q[run.begin]});
    }
    std::sort(of_joint.begin(), of_joint.end(),
              [](const auto& a, const auto& b) { return a.begin < b.begin; });
    stuck.insert(stuck.end(), of_joint.begin(), of_joint.end());
  }
  return stuck;
}

}  // namespace

std::vector<FrozenChannel> FindStuckPositions(const Robot& robot,
                                              const Log& log) {
  return RunsThatJump(robot, log, false);
}

void AddZerosLostAtRest(const Robot& robot, const Log& log, LogJumps* jumps) {
  for (const FrozenChannel& rest : RunsThatJump(robot, log, true)) {
    auto& steps = jumps->joints[rest.joint].steps;
    const auto after =
        std::find_if(steps.begin(), steps.end(),
                     [&](const auto& step) { return step.row >= rest.end; });
    if (after != steps.end() && after->row == rest.end) continue;
    steps.insert(after, {rest.end, rest.jump});
  }
}

std::vector<FrozenChannel> FindAllFrozenChannels(const Robot& robot,
                                                 const Log& log,
                                                 const LogJumps& jumps,
                                                 double mean_step) {
  std::vector<FrozenChannel> frozen = FindStuckPositions(robot, log);
  if (log.tau.size() == 0 || !(mean_step > 0)) return frozen;
  std::vector<RowRange> left_out = RowsOf(frozen);
  const std::vector<RowRange> others = RowsOfOtherZeros(jumps, log.size());
  left_out.insert(left_out.end(), others.begin(), others.end());
  const Log rest = left_out.empty() ? log : WithoutRows(log, left_out);
  for (FrozenChannel run :
       FindFrozenChannels(robot, rest, InspectedSeries(rest, mean_step))) {
    const RowRange all = CountedInAll({run.begin, run.end}, left_out);
    run.begin = static_cast<int>(all.begin);
    run.end = static_cast<int>(all.end);
    frozen.push_back(run);
  }
  return frozen;
}

}  // namespace armcal
