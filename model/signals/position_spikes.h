#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Steps of one joint's recorded position that are none of its motion: in which
// it goes at more than five times the speed that it has when it moves, and in
// the steps around them does not. Step k is from row k to row k + 1. Of time
// stamps t (s) and positions q (rad or m). None where one step in twenty would
// be one: that is another kind of log.
struct PositionSteps {
  std::vector<int> jumps;
  double usual_speed = 0;     // below which nine tenths of the motion are
  double usual_interval = 0;  // s, between rows
};
PositionSteps FindJumps(const Eigen::VectorXd& t, const Eigen::VectorXd& q);

// Rows [begin, end) at which a position is elsewhere, between two jumps of
// which the second brings it back within a tenth of a second.
struct PositionSpike {
  int begin = 0, end = 0;
  double size = 0;  // of the first step, rad or m
};
// Takes the jumps that make spikes out of `steps`.
std::vector<PositionSpike> TakeSpikes(const Eigen::VectorXd& t,
                                      const Eigen::VectorXd& q,
                                      PositionSteps* steps);

// Puts a spike's rows on the line between the rows around.
void Bridge(const PositionSpike& spike, const Eigen::VectorXd& t,
            Eigen::Ref<Eigen::VectorXd> q);

// Puts all spikes on these lines; returns of how many rows. A look at second
// differences spares what has none the rest.
long RemovePositionSpikes(const Eigen::Ref<const Eigen::VectorXd>& t,
                          Eigen::Ref<Eigen::VectorXd> q);

// How many samples were left out, per joint; empty: none were looked for.
using SpikeCounts = Eigen::Array<long, 1, Eigen::Dynamic>;
void AddCounts(const SpikeCounts& more, SpikeCounts* all);

}  // namespace armcal
