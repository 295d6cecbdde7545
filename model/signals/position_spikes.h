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
  double least = 0;           // what a step has to be larger than, rad or m
};
PositionSteps FindJumps(const Eigen::VectorXd& t, const Eigen::VectorXd& q);

// Rows [begin, end) at which a position is elsewhere for a tenth of a second at
// most: between two jumps of which the second brings it back, or between one
// and an end of a stretch, where what is next to it decides. A stretch ends at
// a hole of more than three usual intervals, too.
struct PositionSpike {
  int begin = 0, end = 0;
  double size = 0;  // of the step to them, or, at a beginning, from them
};
// Whether the first row and the last one are ends of a stretch, and not of a
// window that slides over it.
struct StretchEnds {
  bool first = true, last = true;
};
// Takes the jumps that make spikes out of `steps`.
std::vector<PositionSpike> TakeSpikes(const Eigen::VectorXd& t,
                                      const Eigen::VectorXd& q,
                                      const StretchEnds& ends,
                                      PositionSteps* steps);

// The rows of spikes that two joints or more have at once: whatever wrote them
// put no measurement there, and their torques are none either. Of one joint's
// spike its encoder is to blame, and its torque is as good as ever.
std::vector<PositionSpike> WrongRows(
    const std::vector<std::vector<PositionSpike>>& of_joints);

// Puts a spike's rows of a column on the line between the rows around, and at
// an end where the rows next to them go on, mirrored at the last good one.
void Bridge(const PositionSpike& spike, const Eigen::VectorXd& t,
            Eigen::Ref<Eigen::VectorXd> column);

// One joint's spikes; none are taken out. A look at second differences spares
// what has none the rest.
std::vector<PositionSpike> FindSpikes(
    const Eigen::Ref<const Eigen::VectorXd>& t,
    const Eigen::Ref<const Eigen::VectorXd>& q, const StretchEnds& ends = {});

// Bridges them; returns of how many rows.
long RemovePositionSpikes(const Eigen::Ref<const Eigen::VectorXd>& t,
                          Eigen::Ref<Eigen::VectorXd> q);

// How many samples were left out, per joint; empty: none were looked for.
using SpikeCounts = Eigen::Array<long, 1, Eigen::Dynamic>;
void AddCounts(const SpikeCounts& more, SpikeCounts* all);

}  // namespace armcal
