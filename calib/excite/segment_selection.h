#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// Stretches of logs that tell nearly as much as all of them.
struct SegmentSelection {
  double segment_s = 0;
  int considered = 0;  // segments in which something moves
  struct Chosen {
    int log = 0;
    TimeRange range;  // s since the log's first row
    int rank = 0;     // of the directions that it and those before it show
  };
  std::vector<Chosen> chosen;  // the most telling first
  int rank = 0, total = 0;     // of all segments together
  // Standard deviations with the chosen ones over those with all, the geometric
  // mean over parameters.
  double stddev_ratio = 1;

  // Per log in order of time, those that touch as one.
  LogSet::Stretches Stretches(const LogSet& logs) const;
};

// Chooses segments of `segment_s` s one after the other, each time the one that
// makes the confidence ellipsoid smallest (D-optimal), until all directions
// that all the data show are seen and standard deviations are at most
// `most_ratio` times those of all the data. Errors are `linear`'s, a
// calibration with `options` on all of `logs`.
SegmentSelection SelectSegments(const Robot& robot,
                                const LinearCalibration& linear,
                                const LinearCalibrationOptions& options,
                                double segment_s, double most_ratio,
                                const LogSet& logs);

std::string SelectionText(const SegmentSelection& selection,
                          const LogSet& logs);

nlohmann::json ToJson(const SegmentSelection& selection, const LogSet& logs);

}  // namespace armcal
