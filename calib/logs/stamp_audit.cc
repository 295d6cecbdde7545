#include "calib/logs/stamp_audit.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "calib/logs/stamp_hole.h"
#include "calib/numerics/median.h"
#include "model/text/format.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr double kLostShare = .1;
constexpr double kAlike = .1;  // as a share, of steps by velocities

std::vector<double> Steps(const Log& log) {
  std::vector<double> steps;
  for (int k = 0; k + 1 < log.size(); ++k) {
    steps.push_back(log.t[k + 1] - log.t[k]);
  }
  return steps;
}

// Of each row how many follow it with its time, where the row before it has
// another; else 0.
std::vector<int> RunsOfOneTime(const std::vector<double>& steps) {
  std::vector<int> runs(steps.size(), 0);
  for (size_t k = 0; k < steps.size();) {
    size_t end = k;
    while (end < steps.size() && steps[end] == 0) ++end;
    runs[k] = static_cast<int>(end - k);
    k = end + 1;
  }
  return runs;
}

// The middle one of the steps that are of one period, of which `short_one` is
// among the shortest.
double PeriodNear(const std::vector<double>& steps, double short_one) {
  std::vector<double> single;
  for (const double step : steps) {
    if (step > .5 * short_one && step < 1.6 * short_one) single.push_back(step);
  }
  return single.empty() ? short_one : Median(std::move(single));
}

// The share of samples that are lost where steps are whole multiples of a
// period. Rows that are lost make steps of two and three periods and nothing
// in between; stamps that jitter make all of these, and those in between as
// often. So where the steps that are no whole multiple, and longer than one
// period, are as many as those that would have lost a row, none is.
double LostShare(const std::vector<double>& steps, double period) {
  constexpr double kNear = .25;  // of a period
  constexpr long kMost = 100;    // periods, beyond which it is a hole
  long periods = 0, lost = 0, with_losses = 0, between = 0;
  for (const double step : steps) {
    const double ratio = step / period;
    const long whole = std::max(1L, std::lround(ratio));
    if (whole > kMost) continue;
    if (std::abs(ratio - static_cast<double>(whole)) > kNear) {
      if (ratio > 1) ++between;
      continue;
    }
    periods += whole;
    lost += whole - 1;
    if (whole > 1) ++with_losses;
  }
  if (periods == 0 || between >= with_losses) return 0;
  return static_cast<double>(lost) / static_cast<double>(periods);
}

// Where steps may be either, of 4 Hz to 1 Hz in s and of 4 kHz to 1 kHz in ms.
bool MayBeEither(double step) { return step > .25 && step <= 1; }

// How much the positions change by, over what recorded velocities and stamps in
// s make of it, absolute values summed: about 1 if stamps are in s, a
// thousandth if they are in ms. 0 where nothing tells.
double ChangeOverVelocity(const Log& log) {
  if (log.qd.size() == 0) return 0;
  double change = 0, by_velocity = 0;
  for (int k = 0; k + 1 < log.size(); ++k) {
    const double step = log.t[k + 1] - log.t[k];
    change += (log.q.row(k + 1) - log.q.row(k)).cwiseAbs().sum();
    by_velocity +=
        .5 * step * (log.qd.row(k) + log.qd.row(k + 1)).cwiseAbs().sum();
  }
  return by_velocity > 0 ? change / by_velocity : 0;
}

// Whether stamps are the rows' numbers, from 0 or 1.
bool CountsRows(const Log& log) {
  if (log.size() < 3 || (log.t[0] != 0 && log.t[0] != 1)) return false;
  for (int k = 1; k < log.size(); ++k) {
    if (log.t[k] != log.t[0] + k) return false;
  }
  return true;
}

// How long a row is, s, of stamps that count them: the ratio of the positions'
// changes to the recorded velocities, by the joints' median, where more than
// half of the joints have that to a tenth. 0 where nothing tells.
double RowByVelocity(const Log& log) {
  if (log.qd.size() == 0) return 0;
  std::vector<double> told;
  for (int j = 0; j < log.q.cols(); ++j) {
    Log one;
    one.t = log.t;
    one.q = log.q.col(j);
    one.qd = log.qd.col(j);
    const double row = ChangeOverVelocity(one);
    if (row > 0) told.push_back(row);
  }
  if (told.empty()) return 0;
  const double median = Quantile(told, .5);
  const auto alike = std::count_if(told.begin(), told.end(), [&](double row) {
    return std::abs(row / median - 1) < kAlike;
  });
  return 2 * alike > static_cast<long>(told.size()) ? median : 0;
}

// The speed below which the fastest joint is for nine tenths of the steps, if
// stamps are in s.
double UsualSpeed(const Log& log) {
  std::vector<double> speeds;
  for (int k = 0; k + 1 < log.size(); ++k) {
    const double step = log.t[k + 1] - log.t[k];
    if (!(step > 0)) continue;
    speeds.push_back((log.q.row(k + 1) - log.q.row(k)).cwiseAbs().maxCoeff() /
                     step);
  }
  return speeds.empty() ? 0 : Quantile(std::move(speeds), .9);
}

// Of steps that may be either the motion tells: what is 1 in s is a thousandth
// in ms, so that the boundary is their geometric mean. The ratio to recorded
// velocities is 1 whatever unit positions have; arms move at about 1 rad/s.
double UnitByMotion(const Log& log, double step) {
  const double unit = TimeUnitOf(step);
  if (!MayBeEither(step)) return unit;
  const double boundary = std::sqrt(1e-3);
  double told = ChangeOverVelocity(log);
  if (told == 0) told = UsualSpeed(log);
  if (told == 0) return unit;
  return told > boundary ? 1 : 1e-3;
}

void SayOfCounter(const StampFigures& stamps,
                  std::vector<InspectionFinding>* findings) {
  const bool is_told = stamps.row_by_velocity > 0;
  findings->push_back(
      {"row_counter",
       is_told ? "the time counts rows"
               : "the time counts rows, or is in ms at 1 kHz",
       is_told ? Format("it goes on by 1 each row, and by positions and "
                        "recorded velocities a row is %.4g ms",
                        1e3 * stamps.row_by_velocity)
               : Format("it goes on by 1 each row, and no recorded velocity "
                        "tells how long a row is; taken for %s",
                        TimeUnitName(stamps.unit)),
       "log each sample's own time, or multiply the column by a row's"});
}

// Stamps that are rounded repeat alike all along the log, and coarse_stamps
// says that; a clock that stops repeats one for as long as a hole is.
void SayOfStops(const StampFigures& stamps,
                std::vector<InspectionFinding>* findings) {
  if (stamps.stops == 0) return;
  const std::string when =
      stamps.stops == 1
          ? Format("%ld rows after that at %.6g s", stamps.stopped_rows,
                   stamps.first_stop)
          : Format(
                "%ld times, %ld rows together, the first after that at "
                "%.6g s",
                stamps.stops, stamps.stopped_rows, stamps.first_stop);
  findings->push_back(
      {"stopped_clock", "the clock stops while rows go on",
       when + " have its time, and are dropped",
       "log each sample's own time; a stamp made of a message's number, or of "
       "its reception, would do"});
}

}  // namespace

double TimeUnitOf(double step) {
  // Arms are logged at 2 Hz and faster, and, where stamps are in ms, at 1 kHz
  // and slower: this is the geometric mean of steps of .5 s and of 1 ms.
  constexpr double kSlowest = .7;
  double unit = 1;
  while (step * unit > kSlowest && unit > 1e-9) unit /= 1000;
  return unit;
}

const char* TimeUnitName(double unit) {
  return unit == 1 ? "s" : unit == 1e-3 ? "ms" : unit > 5e-7 ? "us" : "ns";
}

InputError WrongTimeUnit(const std::string& path, double step) {
  const std::string name = TimeUnitName(TimeUnitOf(step));
  return InputError(
      path, "", "",
      "the time is in " + name + ", not in s: its step is " + NumberText(step) +
          " as logged, and no arm is sampled every " + NumberText(step) +
          " s, expected a column t[" + name + "]");
}

StampFigures AuditStamps(const Log& log) {
  StampFigures figures;
  std::vector<double> steps = Steps(log);
  figures.duplicates = std::count(steps.begin(), steps.end(), 0.);
  const std::vector<int> runs = RunsOfOneTime(steps);
  steps.erase(std::remove(steps.begin(), steps.end(), 0.), steps.end());
  if (steps.empty()) return figures;
  figures.step = Quantile(steps, .2);
  figures.longest_gap = *std::max_element(steps.begin(), steps.end());
  figures.unit = UnitByMotion(log, figures.step);
  figures.counts_rows = CountsRows(log);
  if (figures.counts_rows) {
    figures.row_by_velocity = RowByVelocity(log);
    // What is s or ms to a tenth is that.
    const double ratio = figures.row_by_velocity / figures.unit;
    figures.counts_rows = !(std::abs(ratio - 1) < kAlike);
    if (figures.counts_rows && ratio > 0)
      figures.unit = figures.row_by_velocity;
  }
  double between = 0;
  for (const double step : steps) {
    if (IsHole(step * figures.unit, figures.step * figures.unit)) {
      ++figures.holes;
      figures.hole_time += step * figures.unit;
    } else {
      between += step;
    }
  }
  figures.mean_step = between / static_cast<double>(std::max(
                                    1L, static_cast<long>(steps.size()) -
                                            static_cast<long>(figures.holes)));
  figures.lost_share = LostShare(steps, PeriodNear(steps, figures.step));
  figures.step *= figures.unit;
  for (size_t k = 0; k < runs.size(); ++k) {
    if (!IsHole(runs[k] * figures.step, figures.step)) continue;
    const double t = figures.unit * (log.t[static_cast<int>(k)] - log.t[0]);
    if (figures.stops++ == 0) figures.first_stop = t;
    figures.stopped_rows += runs[k];
  }
  figures.mean_step *= figures.unit;
  figures.longest_gap *= figures.unit;
  return figures;
}

std::vector<InspectionFinding> StampFindings(const StampFigures& stamps,
                                             int rows) {
  std::vector<InspectionFinding> findings;
  if (stamps.counts_rows) {
    SayOfCounter(stamps, &findings);
  } else if (stamps.unit != 1) {
    const char* name = TimeUnitName(stamps.unit);
    findings.push_back(
        {"time_unit", std::string("the time is in ") + name + ", not in s",
         Format("steps of %.4g as logged: no arm is sampled every %.4g s",
                stamps.step / stamps.unit, stamps.step / stamps.unit),
         std::string("name the column t[") + name + "]"});
  }
  const double coarse =
      static_cast<double>(stamps.duplicates) / static_cast<double>(rows);
  if (coarse > kLostShare) {
    findings.push_back(
        {"coarse_stamps", "many rows have the time of the row before",
         Format("%.0f %% of the rows, which are dropped", 100 * coarse),
         "log the time with more digits"});
  } else {
    SayOfStops(stamps, &findings);
  }
  if (stamps.lost_share > kLostShare) {
    findings.push_back({"lost_samples",
                        "samples are missing between the others",
                        Format("%.0f %% of steps of %.4g ms are not there",
                               100 * stamps.lost_share, 1e3 * stamps.step),
                        "log without losses; single losses are interpolated"});
  }
  if (stamps.holes > 0) {
    findings.push_back(
        {"holes", "the stamps have holes",
         stamps.holes == 1
             ? Format("1 hole, of %.3g s", stamps.hole_time)
             : Format("%ld holes, %.3g s together, the longest %.3g s",
                      stamps.holes, stamps.hole_time, stamps.longest_gap),
         "log without losses; the log is split there"});
  }
  return findings;
}

}  // namespace armcal
