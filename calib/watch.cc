#include "calib/watch.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <map>
#include <utility>

#include "calib/watch/live_rows.h"
#include "calib/watch/watcher.h"
#include "model/log_files/log_reader.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

constexpr double kUsualBandwidth = 20;  // Hz
// Of a slow log's rate: four samples within a radian of the filter's pole, so
// that straight lines between samples are good to some per cent of a sample.
constexpr double kShareOfRate = 1. / 8;
constexpr size_t kRowsForRate = 50;
constexpr long kToldRows = 5;  // of those that are skipped, each by itself
constexpr size_t kKeptEvents = 10000;

void CheckOptions(const WatchOptions& options) {
  const auto above_zero = [](const char* name, double value) {
    if (value > 0) return;
    throw OptionError(OptionName(name) + ": found " + Format("%g", value) +
                      ", expected more than 0");
  };
  above_zero("learn", options.learn_s);
  above_zero("memory", options.memory_s);
  above_zero("false_alarms", options.false_alarms_per_hour);
  if (options.idle_s < 0) {
    throw OptionError(OptionName("idle") + ": expected 0 or more seconds");
  }
}

// One run over a log.
class WatchRun {
 public:
  WatchRun(const Robot& robot, const WatchOptions& options)
      : options_(options), model_(ReadWatchModel(robot, options.calibration)) {}

  void FollowLive(const std::string& path);
  void ReadFinished(const LogSource& log);
  Summary Finish(const std::string& log);

 private:
  void Take(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& tau);
  void StartWatcher();
  void Tell(const WatchEvent& event);
  void Show(bool now);
  bool Stopped() const { return options_.stop && options_.stop(); }

  const WatchOptions& options_;
  WatchModel model_;
  std::optional<Watcher> watcher_;
  std::deque<LiveRow> first_rows_;  // until the log's rate is known
  std::deque<WatchEvent> events_;   // the last ones
  std::map<std::string, long> counts_;
  double time_ = 0, shown_ = -1;
  long rows_ = 0, skipped_ = 0, changes_ = 0;
  std::string torque_source_;
};

void WatchRun::Tell(const WatchEvent& event) {
  ++counts_[WatchEventName(event.kind)];
  changes_ += IsChange(event.kind);
  events_.push_back(event);
  if (events_.size() > kKeptEvents) events_.pop_front();
  if (options_.on_event) options_.on_event(event);
}

// The bandwidth follows from the log's rate, which its first rows tell.
void WatchRun::StartWatcher() {
  WatcherOptions options;
  const size_t steps = first_rows_.size() - 1;
  const double rate =
      steps > 0 ? steps / (first_rows_.back().t - first_rows_.front().t) : 0;
  options.bandwidth_hz = options_.bandwidth_hz.value_or(
      std::min(kUsualBandwidth, kShareOfRate * rate));
  if (!(options.bandwidth_hz > 0) ||
      options.bandwidth_hz > kShareOfRate * rate * 1.01) {
    throw OptionError(OptionName("bandwidth") + ": found " +
                      Format("%g Hz with a log of %g rows a second, expected "
                             "an eighth of that at most",
                             options.bandwidth_hz, rate));
  }
  options.learn_s = options_.learn_s;
  options.memory_s = options_.memory_s;
  options.false_alarms_per_hour = options_.false_alarms_per_hour;
  watcher_.emplace(model_, options,
                   [this](const WatchEvent& event) { Tell(event); });
  for (const LiveRow& row : first_rows_) watcher_->Add(row.t, row.q, row.tau);
  first_rows_.clear();
}

void WatchRun::Take(double t, const Eigen::VectorXd& q,
                    const Eigen::VectorXd& tau) {
  ++rows_;
  time_ = t;
  if (watcher_) {
    watcher_->Add(t, q, tau);
    Show(false);
    return;
  }
  if (!first_rows_.empty() && t <= first_rows_.back().t) return;
  first_rows_.push_back({t, q, tau});
  if (first_rows_.size() == kRowsForRate) StartWatcher();
}

void WatchRun::Show(bool now) {
  if (!options_.on_state || !watcher_) return;
  if (!now && time_ - shown_ < 1 / options_.states_per_second) return;
  shown_ = time_;
  options_.on_state(watcher_->State());
}

void WatchRun::FollowLive(const std::string& path) {
  LiveRows rows(path, options_.follow, options_.idle_s, options_.reading,
                [this](const std::string& why) {
                  ++skipped_;
                  if (skipped_ > kToldRows) return;
                  WatchEvent event;
                  event.kind = WatchEvent::Kind::kBadRow;
                  event.time = event.onset = time_;
                  event.text = why;
                  if (skipped_ == kToldRows) {
                    event.text += "; further ones are counted, not told";
                  }
                  Tell(event);
                });
  LiveRow row;
  while (!Stopped()) {
    const LiveText::Got got = rows.Next(&row);
    if (got == LiveText::Got::kEnd) break;
    if (got == LiveText::Got::kLine) Take(row.t, row.q, row.tau);
    if (got == LiveText::Got::kNothing) Show(true);
  }
  torque_source_ = rows.torque_source();
}

void WatchRun::ReadFinished(const LogSource& source) {
  constexpr int kTogether = 1000;
  LogReader reader(source, options_.reading);
  torque_source_ = reader.torque_source();
  Log log;
  while (!Stopped() && reader.Read(kTogether, &log)) {
    for (int k = 0; k < log.size(); ++k) {
      Take(log.t[k], log.q.row(k), log.tau.row(k));
    }
  }
}

nlohmann::json ValuesJson(const std::vector<WatchedValue>& values) {
  nlohmann::json json = nlohmann::json::array();
  for (const WatchedValue& value : values) {
    json.push_back({{"name", value.name},
                    {"unit", value.unit},
                    {"value", value.value},
                    {"stddev", value.stddev}});
  }
  return json;
}

std::string JsonLines(const std::deque<WatchEvent>& events) {
  std::string lines;
  for (const WatchEvent& event : events) lines += ToJson(event).dump() + "\n";
  return lines;
}

Summary WatchRun::Finish(const std::string& log) {
  if (!watcher_ && first_rows_.size() > 1) StartWatcher();
  if (!watcher_) {
    throw InputError(log, "", "", "expected two rows of different times");
  }
  Show(true);
  const WatchState state = watcher_->State();
  Summary summary;
  // What was not tested is no "nothing has changed".
  summary.positive = changes_ == 0 && !watcher_->learning();
  summary.brief =
      watcher_->learning()
          ? "the log ended before enough motion was seen to learn what is "
            "normal, so nothing was tested; give a smaller " +
                OptionName("learn") +
                Format(" (it is %g s of motion) or a longer log",
                       options_.learn_s)
      : changes_ == 0 ? "nothing has changed"
                      : Format("%ld changes were told", changes_);
  summary.report =
      Format("%.3f s in %ld rows, %ld skipped; delay of the filters %.0f ms\n",
             time_, rows_, skipped_, 1e3 * watcher_->delay());
  for (const WatchedValue& value : state.changes) {
    summary.report += Format("  %-32s %.4g +- %.2g %s\n", value.name.c_str(),
                             value.value, value.stddev, value.unit.c_str());
  }
  summary.report += summary.brief + "\n";
  const nlohmann::json json = {
      {"event", "summary"},
      {"robot", model_.robot.name},
      {"log", log},
      {"torque", torque_source_},
      {"seconds", time_},
      {"rows", rows_},
      {"rows_skipped", skipped_},
      {"filter_delay_s", watcher_->delay()},
      {"learned", !watcher_->learning()},
      {"counts", counts_},
      {"changes", ValuesJson(state.changes)},
      {"estimate", ValuesJson(watcher_->WholeLogEstimate())}};
  summary.json = json.dump() + "\n";
  summary.files = {{"watch.json", json.dump(2) + "\n"},
                   {"events.jsonl", JsonLines(events_)}};
  return summary;
}

}  // namespace

Summary Watch(const Robot& robot, const LogSource& log,
              const WatchOptions& options) {
  CheckOptions(options);
  WatchRun run(robot, options);
  const bool pipe = log.arrays == nullptr && log.name == "-";
  if (pipe || options.follow) {
    run.FollowLive(log.name);
  } else {
    run.ReadFinished(log);
  }
  return run.Finish(pipe ? "standard input" : log.name);
}

}  // namespace armcal
