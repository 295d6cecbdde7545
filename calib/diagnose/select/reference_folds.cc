#include "calib/diagnose/select/reference_folds.h"

#include <set>

namespace armcal {
namespace {

constexpr int kThirds = 3;

std::set<int> LogsOf(const std::vector<GapSegment>& segments) {
  std::set<int> logs;
  for (const GapSegment& segment : segments) logs.insert(segment.log);
  return logs;
}

}  // namespace

TimeRange ReferenceFold::WindowOf(const GapSegment& segment) const {
  const Motion& motion = segment.motion;
  const double end = motion.time(motion.size() - 1);
  if (third < 0) return {motion.t0, end};
  const double length = (end - motion.t0) / kThirds;
  return {motion.t0 + third * length, motion.t0 + (third + 1) * length};
}

bool AreSeveralLogs(const std::vector<GapSegment>& segments) {
  return LogsOf(segments).size() > 1;
}

std::vector<ReferenceFold> FoldsOf(const std::vector<GapSegment>& segments) {
  const std::set<int> logs = LogsOf(segments);
  std::vector<ReferenceFold> folds;
  if (logs.size() > 1) {
    for (const int log : logs) folds.push_back({log, -1});
  } else {
    for (int third = 0; third < kThirds; ++third) folds.push_back({-1, third});
  }
  return folds;
}

std::vector<int> LeaveOut(const std::vector<GapSegment>& segments,
                          const ReferenceFold& fold, GapData* data) {
  std::vector<int> left_out;
  for (size_t i = 0; i < segments.size(); ++i) {
    const int log = segments[i].log, s = static_cast<int>(i);
    if (fold.log >= 0 && log != fold.log) continue;
    const TimeRange window = fold.WindowOf(segments[i]);
    data->Mask(log, window);
    const GapRows& rows = data->rows();
    for (int k = rows.thin_begin(s); k < rows.thin_begin(s + 1); ++k) {
      if (window.Contains(rows.thin_time(s, k))) left_out.push_back(k);
    }
  }
  return left_out;
}

}  // namespace armcal
