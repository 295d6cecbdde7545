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
// Of the smallest step, to which another one takes it back: as of spikes.
constexpr double kTakenBack = .2;

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

// Whether a joint is off its way at a spike's rows, beyond both rows around
// them, between which it goes as fast as it may in motion (FindJumps' five
// times the usual speed). Where time is missing it is ahead on its way.
bool IsOffItsWay(const PositionSpike& spike, const VectorXd& t,
                 const VectorXd& q, double usual_speed) {
  if (spike.begin == 0 || spike.end == q.size()) return false;
  const double before = q[spike.begin - 1], after = q[spike.end];
  const auto rows = q.segment(spike.begin, spike.end - spike.begin).array();
  const bool is_beyond = (rows < std::min(before, after)).all() ||
                         (rows > std::max(before, after)).all();
  return is_beyond && std::abs(after - before) <
                          5 * usual_speed * (t[spike.end] - t[spike.begin - 1]);
}

// A row that a logger made up is wrong in all columns, and one of them may be
// there where its value is near by chance: zeros in a joint that is about to
// pass zero. Going there is no jump then, or coming back is none, and what is
// left looks like a zero that was lost, or, at an end of a log, like good rows
// that are wrong. So where another joint has a spike, this one's jumps to these
// rows and from them are part of it, if on the line between the rows around it
// has none there.
void TakeOthersSpikes(const std::vector<std::vector<PositionSpike>>& found,
                      const VectorXd& t, const VectorXd& q, size_t j,
                      PositionSteps* left, std::vector<PositionSpike>* own) {
  for (size_t other = 0; other < found.size(); ++other) {
    if (other == j) continue;
    for (const PositionSpike& spike : found[other]) {
      const auto is_at_it = [&](int k) {
        return spike.begin <= k + 1 && k + 1 <= spike.end;
      };
      const auto is_more = [&](const PositionSpike& one) {
        return one.begin <= spike.begin && spike.end <= one.end &&
               (is_at_it(one.begin - 1) || is_at_it(one.end - 1)) &&
               one.end - one.begin > spike.end - spike.begin;
      };
      auto& jumps = left->jumps;
      const auto step = std::find_if(jumps.begin(), jumps.end(), is_at_it);
      const auto part = std::find_if(own->begin(), own->end(), is_more);
      if (step == jumps.end() && part == own->end()) continue;
      VectorXd bridged = q;
      Bridge(spike, t, bridged);
      const std::vector<int> still = FindJumps(t, bridged).jumps;
      const auto is_of_part = [&](int k) {
        return part != own->end() &&
               (k + 1 == part->begin || k + 1 == part->end);
      };
      if (!IsOffItsWay(spike, t, q, left->usual_speed) ||
          std::any_of(still.begin(), still.end(),
                      [&](int k) { return is_at_it(k) || is_of_part(k); })) {
        continue;
      }
      jumps.erase(std::remove_if(jumps.begin(), jumps.end(), is_at_it),
                  jumps.end());
      own->erase(std::remove_if(own->begin(), own->end(), is_more), own->end());
      own->push_back(
          {spike.begin, spike.end, q[spike.begin] - q[spike.begin - 1]});
    }
  }
  std::sort(own->begin(), own->end(),
            [](const auto& a, const auto& b) { return a.begin < b.begin; });
}

// The stretches of a log in which a joint has one zero.
struct ZeroRows {
  double zero = 0;  // beside that of the first row, rad or m
  long count = 0;
  std::vector<RowRange> rows;
};

std::vector<ZeroRows> ZerosOf(const std::vector<PositionJumps::Step>& steps,
                              int rows, const std::vector<RowRange>& used) {
  std::vector<ZeroRows> zeros;
  double zero = 0, smallest = INFINITY;
  long begin = 0;
  for (const PositionJumps::Step& step : steps) {
    smallest = std::min(smallest, std::abs(step.size));
  }
  const auto add = [&](long end) {
    auto same = std::find_if(zeros.begin(), zeros.end(), [&](const auto& one) {
      return std::abs(one.zero - zero) <= kTakenBack * smallest;
    });
    if (same == zeros.end()) same = zeros.insert(zeros.end(), {zero, 0, {}});
    for (const RowRange& part : used) {
      same->count +=
          std::max(0L, std::min(end, part.end) - std::max(begin, part.begin));
    }
    same->rows.push_back({begin, end});
    begin = end;
  };
  for (const PositionJumps::Step& step : steps) {
    add(step.row);
    zero += step.size;
  }
  add(rows);
  return zeros;
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
    spikes.push_back(of_joint.spikes);
    left.push_back(steps);
    found.joints.push_back(of_joint);
  }
  const std::vector<std::vector<PositionSpike>> of_each = spikes;
  for (size_t j = 0; j < spikes.size(); ++j) {
    auto q = mended.q.col(static_cast<Eigen::Index>(j));
    TakeOthersSpikes(of_each, t, q, j, &left[j], &spikes[j]);
    for (const PositionSpike& spike : spikes[j]) Bridge(spike, t, q);
    found.joints[j].spikes = spikes[j];
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

std::vector<RowRange> RowsOfOtherZeros(const LogJumps& jumps, int rows,
                                       std::vector<RowRange> used) {
  if (used.empty()) used = {{0, rows}};
  std::vector<RowRange> left_out;
  for (const PositionJumps& of_joint : jumps.joints) {
    if (of_joint.steps.empty()) continue;
    const std::vector<ZeroRows> zeros = ZerosOf(of_joint.steps, rows, used);
    const auto usual = std::max_element(
        zeros.begin(), zeros.end(),
        [](const auto& a, const auto& b) { return a.count < b.count; });
    for (auto zero = zeros.begin(); zero != zeros.end(); ++zero) {
      if (zero == usual) continue;
      left_out.insert(left_out.end(), zero->rows.begin(), zero->rows.end());
    }
  }
  return left_out;
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
