#include "calib/logs/log_set.h"

#include <algorithm>
#include <utility>

#include "calib/logs/recorded_logs.h"

namespace armcal {

LogSet::LogSet(const std::vector<LogSource>& sources,
               const LogReaderOptions& log_options, const TimeRange& crop,
               std::size_t memory_bytes)
    : recorded_(std::make_shared<RecordedLogs>()) {
  RecordedLogs& r = *recorded_;
  r.memory = std::make_shared<MemoryBudget>(memory_bytes);
  r.crop = crop;
  for (const LogSource& source : sources) {
    r.names.push_back(source.name);
    r.rows.emplace_back(source, log_options, r.memory);
    r.time_bases.push_back(AuditTimeBase(crop, &r.rows.back()));
    r.torque_source = r.rows.back().torque_source();
    r.torque_constants_stddev = std::max(
        r.torque_constants_stddev, r.rows.back().torque_constants_stddev());
    r.has_wrench = r.has_wrench || r.rows.back().has_wrench();
    r.has_current = r.has_current || r.rows.back().has_current();
    const auto found = log_options.reconstructed_torque.find(source.name);
    r.reconstructed.push_back(found == log_options.reconstructed_torque.end()
                                  ? nullptr
                                  : found->second);
  }
}

LogSet LogSet::Within(Stretches stretches) const {
  LogSet logs = *this;
  logs.stretches_ = std::move(stretches);
  return logs;
}

int LogSet::size() const { return static_cast<int>(recorded_->names.size()); }

const std::string& LogSet::path(int log) const { return recorded_->names[log]; }

const std::vector<TimeBase>& LogSet::time_bases() const {
  return recorded_->time_bases;
}

const std::string& LogSet::torque_source() const {
  return recorded_->torque_source;
}

double LogSet::torque_constants_stddev() const {
  return recorded_->torque_constants_stddev;
}

const ReconstructedTorque* LogSet::reconstructed_torque(int log) const {
  return recorded_->reconstructed[log].get();
}

bool LogSet::has_wrench() const { return recorded_->has_wrench; }

bool LogSet::has_current() const { return recorded_->has_current; }

const std::shared_ptr<MemoryBudget>& LogSet::memory() const {
  return recorded_->memory;
}

}  // namespace armcal
