#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/log_files/log.h"
#include "model/log_files/row_range.h"
#include "model/robot/robot.h"
#include "model/signals/position_spikes.h"

namespace armcal {

// Where one joint's recorded position leaves its motion (FindJumps) while the
// others go on as before.
struct PositionJumps {
  struct Step {
    int row = 0;      // the first one after it
    double size = 0;  // rad or m
  };
  std::vector<PositionSpike> spikes;
  std::vector<Step> wraps;  // by whole turns, of joints that turn
  std::vector<Step> steps;  // by anything else, for good
};

struct LogJumps {
  std::vector<PositionJumps> joints;
  // Rows that are wrong as a whole (WrongRows): several joints' spikes at once.
  std::vector<PositionSpike> wrong_rows;
  // Rows at which one joint jumps and others that move are ahead of themselves,
  // too: the log misses time there, or two logs meet, and no encoder is to
  // blame.
  std::vector<int> missing_time;
};

// The log has its time in s.
LogJumps FindPositionJumps(const Robot& robot, const Log& log);

// Takes the turns out again, and puts spikes, and all signals of wrong rows, on
// the line between the rows around. Steps stay: which side has the right zero,
// nobody knows.
void MendJumps(const LogJumps& jumps, Log* log);

// Rows that are left out where a joint's zero is another one after a step: all
// but those of the zero that it has for most of the `used` ones of the log's
// `rows` (none: of all). A step that takes an earlier one back, to a fifth of
// the joint's smallest step, leads to the earlier zero.
std::vector<RowRange> RowsOfOtherZeros(const LogJumps& jumps, int rows,
                                       std::vector<RowRange> used = {});

}  // namespace armcal
