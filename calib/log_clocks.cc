#include "calib/log_clocks.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "calib/logs/clock_text.h"
#include "calib/logs/sample_clock.h"
#include "model/effects/effects.h"
#include "model/log_files/log_reader.h"

namespace armcal {

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
    if (!clock.wrong()) continue;
    DataFinding finding;
    finding.leads = true;
    finding.finding = "of " + source.name + " " + ClockSentence(clock);
    finding.evidence = ClockEvidence(clock);
    if (reader.Read(1, &more)) {
      finding.flag =
          "log each sample's own time: nothing below is to be "
          "trusted";
    } else {
      finding.flag =
          "what follows is of the time that the joints tell, and tells no law "
          "beyond joint terms, loads and errors of the recording";
      reading->sample_times[source.name] =
          std::make_shared<const Eigen::VectorXd>(std::move(clock.t));
    }
    wrong.push_back({source.name, std::move(finding), 1 / clock.rate - 1,
                     clock.period_stddev / clock.period / clock.rate,
                     clock.wrong_rate});
  }
  return wrong;
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
