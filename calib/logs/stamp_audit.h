#pragma once

#include <string>
#include <vector>

#include "calib/logs/inspection_finding.h"
#include "model/log_files/log.h"
#include "model/text/input_error.h"

namespace armcal {

// By which stamps with such steps have to be multiplied to be seconds: 1, or
// 1e-3, 1e-6, 1e-9 where no arm is logged that slowly. And what that is called.
// Steps of .25 to 1 may be of a slow log in s or of a fast one in ms: these are
// told by their length alone here, and AuditStamps asks the motion.
double TimeUnitOf(double step);
const char* TimeUnitName(double unit);
// Of a log whose steps, as logged, no arm has in seconds: what unit they are
// in.
InputError WrongTimeUnit(const std::string& path, double step);

// What the stamps of a log are like.
struct StampFigures {
  double step = 0;        // s, the shortest usual one
  double mean_step = 0;   // s
  double lost_share = 0;  // of samples, where steps are multiples of `step`
  long duplicates = 0;    // rows that have the time of the row before
  // Of these, runs that are as long as a hole: how often, rows together, and
  // the first one's time, s since the log's first row.
  long stops = 0, stopped_rows = 0;
  double first_stop = 0;
  double longest_gap = 0;  // s
  // Steps over three usual ones and over kHole: they split the log.
  long holes = 0;
  double hole_time = 0;  // s, of all of them
  double unit = 1;       // by which stamps were multiplied to be s
  // Stamps are 0, 1, 2, .. or 1, 2, 3, ..: a row's number, or ms at 1 kHz. What
  // recorded velocities make of a row, s, if they tell; it is `unit` then.
  bool counts_rows = false;
  double row_by_velocity = 0;
};
StampFigures AuditStamps(const Log& log);

// What is wrong with them: their unit, a clock that stops, samples that are
// lost, holes. `rows`: of the log.
std::vector<InspectionFinding> StampFindings(const StampFigures& stamps,
                                             int rows);

}  // namespace armcal
