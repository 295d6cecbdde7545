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

// Takes the jumps by whole turns out of `steps`.
std::vector<PositionJumps::Step> TakeWraps(const VectorXd& q,
                                           PositionSteps* steps) {
  std::vector<PositionJumps::Step> wraps;
  std::vector<int> others;
  for (const int k : steps->jumps) {
    const double size = WholeTurns(q[k + 1] - q[k]);
    if (size != 0) {
      wraps.push_back({k + 1, size});
    } else {
      others.push_back(k);
    }
  }
  steps->jumps = others;
  return wraps;
}

}  // namespace

LogJumps FindPositionJumps(const Robot& robot, const Log& log) {
  LogJumps found;
  const VectorXd t = log.t;
  Log mended;  // of what leaves its motion and comes back
  mended.q = log.q;
  std::vector<PositionSteps> left;  // of each joint
  std::vector<std::vector<PositionSpike>> spikes;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const VectorXd q = log.q.col(j);
    PositionJumps of_joint;
    PositionSteps steps = FindJumps(t, q);
    if (IsRotational(robot.links[j].joint.type)) {
      of_joint.wraps = TakeWraps(q, &steps);
    }
    of_joint.spikes = TakeSpikes(t, q, {}, &steps);
    for (const PositionSpike& spike : of_joint.spikes) {
      Bridge(spike, t, mended.q.col(j));
    }
    spikes.push_back(of_joint.spikes);
    left.push_back(steps);
    found.joints.push_back(of_joint);
  }
  found.wrong_rows = WrongRows(spikes);
  std::set<int> missing;
  for (int j = 0; j < robot.num_joints(); ++j) {
    for (const int k : left[j].jumps) {
      if (IsAnyOtherAhead(mended, j, k, left[j].usual_interval)) {
        missing.insert(k + 1);
      } else {
        found.joints[j].steps.push_back({k + 1, log.q(k + 1, j) - log.q(k, j)});
      }
    }
  }
  found.missing_time.assign(missing.begin(), missing.end());
  return found;
}

void MendJumps(const LogJumps& jumps, Log* log) {
  for (Eigen::MatrixXd* x :
       {&log->q, &log->tau, &log->qd, &log->qdd, &log->qref, &log->temperature,
        &log->wrench, &log->current}) {
    for (const PositionSpike& row : jumps.wrong_rows) {
      for (Eigen::Index c = 0; c < x->cols(); ++c) {
        Bridge(row, log->t, x->col(c));
      }
    }
  }
  for (size_t j = 0; j < jumps.joints.size(); ++j) {
    auto q = log->q.col(static_cast<Eigen::Index>(j));
    for (const PositionSpike& spike : jumps.joints[j].spikes) {
      Bridge(spike, log->t, q);
    }
    for (const PositionJumps::Step& wrap : jumps.joints[j].wraps) {
      q.tail(q.size() - wrap.row).array() -= wrap.size;
    }
  }
}

}  // namespace armcal
