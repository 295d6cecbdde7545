#include "calib/log_clocks.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "calib/logs/clock_text.h"
#include "calib/logs/sample_clock.h"
#include "model/effects/effects.h"
#include "model/log_files/log_reader.h"

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

}  // namespace

std::vector<WrongClock> MendClocks(const std::vector<LogSource>& logs,
                                   LogReaderOptions* reading) {
  constexpr int kMostRows = 1 << 20;
  std::vector<WrongClock> wrong;
  for (const LogSource& source : logs) {
    LogReaderOptions wanted = *reading;
    wanted.want_velocity = true;
    wanted.need_torque = false;
    LogReader reader(source, wanted);
    if (!reader.has_velocity()) continue;
    Log log, more;
    reader.Read(kMostRows, &log);
    SampleClock clock = EstimateSampleClock(log);
    if (!clock.wrong() && !clock.jitters) continue;
    const bool is_mended = reader.Read(1, &more) == 0;
    wrong.push_back({source.name, FindingOf(source.name, clock, is_mended),
                     1 / clock.rate - 1,
                     clock.period_stddev / clock.period / clock.rate,
                     clock.wrong_rate, clock.jitters});
    if (!is_mended) continue;
    reading->sample_times[source.name] =
        std::make_shared<const Eigen::VectorXd>(std::move(clock.t));
  }
  return wrong;
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
