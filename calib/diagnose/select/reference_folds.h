#pragma once

#include <vector>

#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/segment.h"
#include "model/log_files/time_base.h"

namespace armcal {

// What is left out of a reference at a time, so that a fit to the rest meets
// motion that it has not seen: whole logs where there are several, which differ
// from each other as the diagnosed one does from them; else a third of each
// segment of the only one.
struct ReferenceFold {
  int log;    // -1: of every log
  int third;  // -1: all of it

  TimeRange WindowOf(const GapSegment& segment) const;  // s
};

// One or more; all of whole logs, or all of thirds.
std::vector<ReferenceFold> FoldsOf(const std::vector<GapSegment>& segments);

// Whether they are of several logs, which tell how one differs from another.
bool AreSeveralLogs(const std::vector<GapSegment>& segments);

// Masks a fold in the data, which are of these segments; the thinned samples
// that are in it.
std::vector<int> LeaveOut(const std::vector<GapSegment>& segments,
                          const ReferenceFold& fold, GapData* data);

}  // namespace armcal
