#include "calib/logs/stamp_audit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "calib/logs/stamp_hole.h"
#include "calib/numerics/median.h"
#include "model/text/format.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

constexpr double kLostShare = .1;

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
  // Arms are logged every 0.1 ms to 0.25 s.
  constexpr double kSlowest = .25;
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
  figures.unit = TimeUnitOf(figures.step);
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
  if (stamps.unit != 1) {
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
