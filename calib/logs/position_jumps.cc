#include "calib/logs/position_jumps.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "model/robot/axis_rotation.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

constexpr double kOfATurn = .1;    // by which a turn may be off: motion goes on
constexpr double kOfMotion = .02;  // rad/s or m/s
// Times its steps around that a joint goes in a step that misses a row and
// more; one that starts or stops goes less.
constexpr double kAhead = 2.5;

// The whole turns in a step, in rad, or in degrees where it is that large; 0
// where it is none.
double WholeTurns(double size) {
  constexpr double kDegrees = 50;  // more rad than an arm goes in a step
  const double turn = std::abs(size) > kDegrees ? 360 : 2 * M_PI;
  const double turns = turn * std::round(size / turn);
  return std::abs(size - turns) < kOfATurn * turn ? turns : 0;
}

// Whether a joint that moves goes ahead of itself in step k, by what its steps
// around are.
bool IsAhead(const VectorXd& q, Eigen::Index k, double usual_interval) {
  double around = 0;
  int count = 0;
  for (const Eigen::Index near : {k - 2, k - 1, k + 1, k + 2}) {
    if (near < 0 || near + 1 >= q.size()) continue;
    around += std::abs(q[near + 1] - q[near]);
    ++count;
  }
  around /= std::max(1, count);
  return around > kOfMotion * usual_interval &&
         std::abs(q[k + 1] - q[k]) > kAhead * around;
}

// Whether any joint but j is.
bool IsAnyOtherAhead(const Log& log, int j, int k, double usual_interval) {
  for (int other = 0; other < log.q.cols(); ++other) {
    if (other != j && IsAhead(log.q.col(other), k, usual_interval)) return true;
  }
  return false;
}

}  // namespace

LogJumps FindPositionJumps(const Robot& robot, const Log& log) {
  LogJumps found;
  const VectorXd t = log.t;
  std::set<int> missing;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const VectorXd q = log.q.col(j);
    const bool turns = IsRotational(robot.links[j].joint.type);
    PositionJumps of_joint;
    PositionSteps steps = FindJumps(t, q);
    std::vector<int> others;
    for (const int k : steps.jumps) {
      const double size = turns ? WholeTurns(q[k + 1] - q[k]) : 0;
      if (size != 0) {
        of_joint.wraps.push_back({k + 1, size});
      } else if (IsAnyOtherAhead(log, j, k, steps.usual_interval)) {
        missing.insert(k + 1);
      } else {
        others.push_back(k);
      }
    }
    steps.jumps = others;
    of_joint.spikes = TakeSpikes(t, q, &steps);
    for (const int k : steps.jumps) {
      of_joint.steps.push_back({k + 1, q[k + 1] - q[k]});
    }
    found.joints.push_back(of_joint);
  }
  found.missing_time.assign(missing.begin(), missing.end());
  return found;
}

void MendJumps(const std::vector<PositionJumps>& jumps, Log* log) {
  for (size_t j = 0; j < jumps.size(); ++j) {
    auto q = log->q.col(static_cast<Eigen::Index>(j));
    for (const PositionSpike& spike : jumps[j].spikes) Bridge(spike, log->t, q);
    for (const PositionJumps::Step& wrap : jumps[j].wraps) {
      q.tail(q.size() - wrap.row).array() -= wrap.size;
    }
  }
}

}  // namespace armcal
