#include "calib/diagnose/data/enough_motion.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/rows.h"
#include "calib/logs/stamp_audit.h"
#include "model/signals/bandwidth.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// The path of the log with the longest usual step.
const std::string& SlowestOf(const LogSet& logs) {
  const std::vector<TimeBase>& all = logs.time_bases();
  int slowest = 0;
  for (int k = 1; k < logs.size(); ++k) {
    if (all[k].median_step > all[slowest].median_step) slowest = k;
  }
  return logs.path(slowest);
}

}  // namespace

SplittingGaps GapsThatSplit(double bandwidth_hz, const LogSet& logs) {
  SplittingGaps found;
  for (const TimeBase& base : logs.time_bases()) {
    for (const TimeRange& gap : base.gaps) {
      const double step = gap.end - gap.begin;
      if (step <= kGapPeriods / bandwidth_hz) continue;
      ++found.count;
      found.longest = std::max(found.longest, step);
    }
  }
  return found;
}

std::string SplittingGaps::Text() const {
  return count == 1 ? Format("its gap of %.3g s", longest)
                    : Format("its %ld gaps of up to %.3g s", count, longest);
}

double SplittingGaps::BridgingBandwidth() const {
  return std::floor(kGapPeriods / longest);
}

// A time in ms leaves no motion either: then the unit is told. Where a log of a
// low rate leaves all of them a bandwidth too low for these, it is to blame.
void CheckMotion(const std::vector<GapSegment>& segments, double bandwidth_hz,
                 const LogSet& logs, const LogSet* sets_bandwidth) {
  if (GapRows(segments, bandwidth_hz).num_rows() > 0) return;
  for (int k = 0; k < logs.size(); ++k) {
    const double step = logs.time_bases()[k].median_step;
    if (TimeUnitOf(step) != 1) throw WrongTimeUnit(logs.path(k), step);
  }
  const double needed =
      std::max(kShortestSegment, GapRows::Shortest(bandwidth_hz));
  const SplittingGaps gaps = GapsThatSplit(bandwidth_hz, logs);
  std::string remedy = "or a higher " + OptionName("bandwidth") + " than " +
                       NumberText(bandwidth_hz) + " Hz";
  if (gaps.count > 0 && gaps.BridgingBandwidth() >= 1) {
    remedy = "or " + OptionName("bandwidth") + "=" +
             NumberText(gaps.BridgingBandwidth()) +
             ", for which these gaps are bridged";
  }
  std::string of = "it", path = logs.path(0);
  if (sets_bandwidth != nullptr &&
      DiagnosisBandwidth(logs.time_bases()) > bandwidth_hz) {
    of = path +
         Format(" at the %g Hz that this log's rate allows", bandwidth_hz);
    path = SlowestOf(*sets_bandwidth);
  }
  if (gaps.count > 0) {
    of += " between " + gaps.Text() + ", where samples are missing";
  }
  throw InputError(path, "", "",
                   "no motion is left of " + of + ", expected " +
                       NumberText(std::ceil(10 * needed) / 10) +
                       " s of it without gap or standstill, " + remedy);
}

}  // namespace armcal
