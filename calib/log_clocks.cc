#include "calib/log_clocks.h"

#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "calib/logs/clock_text.h"
#include "calib/logs/sample_clock.h"
#include "calib/logs/stamp_audit.h"
#include "model/effects/effects.h"
#include "model/log_files/log_reader.h"
#include "model/log_files/row_range.h"

namespace armcal {
namespace {

DataFinding FindingOf(const std::string& log, const SampleClock& clock,
                      bool is_mended) {
  DataFinding finding;
  finding.finding = "of " + log + " ";
  if (clock.jitters) {
    finding.finding += JitterSentence(clock);
    finding.evidence = JitterEvidence(clock);
    finding.flag = is_mended ? "what follows is of the time that the joints "
                               "tell; log each sample's own time"
                             : "log each sample's own time";
    return finding;
  }
  finding.leads = true;
  finding.finding += ClockSentence(clock);
  finding.evidence = ClockEvidence(clock);
  finding.flag =
      is_mended
          ? "what follows is of the time that the joints tell, and tells no "
            "law beyond joint terms, loads and errors of the recording"
          : "log each sample's own time: nothing below is to be trusted";
  return finding;
}

// The time of each row, s since the first, of stamps `all` of which those but
// the ones `left_out` were taken at the times `told`: on the line between the
// rows around by stamps, and before the first and after the last as fast as the
// others are.
Eigen::VectorXd TimeOfAllRows(const Eigen::VectorXd& all,
                              const std::vector<RowRange>& left_out,
                              const Eigen::VectorXd& told) {
  std::vector<Eigen::Index> rows;  // that are told
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    if (!AnyContains(left_out, k)) rows.push_back(k);
  }
  const Eigen::Index last = told.size() - 1;
  const double rate =
      (told[last] - told[0]) / (all[rows.back()] - all[rows.front()]);
  Eigen::VectorXd t(all.size());
  Eigen::Index next = 0;  // the first told row that is not before row k
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    while (next <= last && rows[next] < k) ++next;
    if (next == 0 || next > last) {
      const Eigen::Index end = std::min(next, last);
      t[k] = told[end] + rate * (all[k] - all[rows[end]]);
      continue;
    }
    const double before = all[rows[next - 1]], after = all[rows[next]];
    const double share =
        after > before ? (all[k] - before) / (after - before) : 1;
    t[k] = told[next - 1] + share * (told[next] - told[next - 1]);
    if (rows[next] == k) t[k] = told[next];
  }
  return t.array() - t[0];
}

}  // namespace

std::vector<WrongClock> MendClocks(const std::vector<LogSource>& logs,
                                   const LogReaderOptions& mended,
                                   LogReaderOptions* reading) {
  constexpr int kMostRows = 1 << 20;
  std::vector<WrongClock> wrong;
  for (const LogSource& source : logs) {
    LogReaderOptions wanted = mended;
    wanted.left_out.clear();
    wanted.want_velocity = true;
    wanted.need_torque = false;
    LogReader reader(source, wanted);
    if (!reader.has_velocity()) continue;
    Log log, more;
    reader.Read(kMostRows, &log);
    const std::vector<RowRange> left_out = mended.LeftOutOf(source.name);
    const SampleClock clock = EstimateSampleClock(WithoutRows(log, left_out));
    if (!clock.wrong() && !clock.jitters) continue;
    const bool is_mended = reader.Read(1, &more) == 0;
    wrong.push_back({source.name, FindingOf(source.name, clock, is_mended),
                     1 / clock.rate - 1,
                     clock.period_stddev / clock.period / clock.rate,
                     clock.wrong_rate, clock.jitters});
    if (!is_mended) continue;
    reading->sample_times[source.name] =
        std::make_shared<const Eigen::VectorXd>(
            TimeOfAllRows(log.t, left_out, clock.t));
  }
  return wrong;
}

void CheckTimeUnits(const std::vector<const LogSet*>& sets) {
  std::set<double> units;
  const std::string* path = nullptr;
  double slowest = 0;
  for (const LogSet* logs : sets) {
    for (int k = 0; logs != nullptr && k < logs->size(); ++k) {
      const double step = logs->time_bases()[k].median_step;
      units.insert(TimeUnitOf(step));
      if (step <= slowest) continue;
      slowest = step;
      path = &logs->path(k);
    }
  }
  if (units.size() < 2) return;
  throw WrongTimeUnit(*path, slowest);
}

bool AreLawsInDoubt(const std::vector<WrongClock>& clocks) {
  return std::any_of(clocks.begin(), clocks.end(),
                     [](const WrongClock& clock) { return !clock.jitters; });
}

// Beyond five deviations, as SampleClock has it: what is left is that all
// velocities are in another unit alike.
std::optional<FoundEffect> FoundClock(const std::vector<WrongClock>& clocks,
                                      const std::vector<LogSource>& logs) {
  constexpr double kOtherUnit = .01;
  for (const WrongClock& clock : clocks) {
    const bool is_of_these = std::any_of(
        logs.begin(), logs.end(),
        [&](const LogSource& source) { return source.name == clock.log; });
    if (!is_of_these || !clock.wrong_rate) continue;
    FoundEffect found;
    found.effect = &ClockEffect();
    found.probability = 1 - kOtherUnit;
    found.of_the_stamps = true;
    found.estimates = {{"rate", "1", clock.rate}};
    found.stddev = {clock.rate_stddev};
    return found;
  }
  return std::nullopt;
}

}  // namespace armcal
