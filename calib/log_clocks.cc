#include "calib/log_clocks.h"

#include <memory>

#include "calib/logs/clock_text.h"
#include "calib/logs/sample_clock.h"
#include "model/log_files/log_reader.h"

namespace armcal {

std::vector<DataFinding> MendClocks(const std::vector<LogSource>& logs,
                                    LogReaderOptions* reading) {
  constexpr int kMostRows = 1 << 20;
  std::vector<DataFinding> findings;
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
          "beyond joint terms and errors of the recording";
      reading->sample_times[source.name] =
          std::make_shared<const Eigen::VectorXd>(std::move(clock.t));
    }
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace armcal
