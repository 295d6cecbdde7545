#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/diagnose/data/audit.h"
#include "calib/diagnose/judge/found_effect.h"
#include "calib/logs/log_set.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"

namespace armcal {

// A log whose stamps are not when its samples were taken, as positions and
// velocities of all joints tell (EstimateSampleClock).
struct WrongClock {
  std::string log;
  DataFinding finding;  // leads a diagnosis
  // What stamps grow by per second of true time, less 1.
  double rate = 0;
  double rate_stddev = 0;
  bool wrong_rate = false;  // SampleClock's; else stamps are uneven alone
  // Its stamps jitter about a time that is right, which the joints tell to less
  // than that: no reason to doubt anything.
  bool jitters = false;
};

// Of those logs whose clock is wrong. They are read with the time that their
// joints tell from then on (LogReaderOptions::sample_times), but for logs of
// more than 2^20 rows. `mended`: the same reading with positions mended
// (MendPositions), since what jumps or stands still tells no time; rows that
// it leaves out have the time between the rows around.
std::vector<WrongClock> MendClocks(const std::vector<LogSource>& logs,
                                   const LogReaderOptions& mended,
                                   LogReaderOptions* reading);

// Refuses logs whose time is in different units, which have no bandwidth in
// common. Where all are in one, a diagnosis says so itself. Null: no logs.
void CheckTimeUnits(const std::vector<const LogSet*>& sets);

// Whether the time of one of these is an estimate that laws may be wrong by.
bool AreLawsInDoubt(const std::vector<WrongClock>& clocks);

// The first of these logs' clocks that runs at another rate as an effect
// (ClockEffect); none where all run at theirs. Of motion in the mended time
// there is nothing of it left to fit, so that it removes nothing there.
std::optional<FoundEffect> FoundClock(const std::vector<WrongClock>& clocks,
                                      const std::vector<LogSource>& logs);

}  // namespace armcal
