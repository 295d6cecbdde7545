#include "calib/excite/segment_selection.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "calib/excite/given_information.h"
#include "calib/excite/information_scale.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// log det of I + A: directions that nothing shows count as known to a joint's
// torque, as those that are next to nothing do.
double LogDet(const MatrixXd& A) {
  const MatrixXd whole = MatrixXd::Identity(A.rows(), A.cols()) + A;
  const Eigen::LLT<MatrixXd> factor(whole);
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

LogSet::Stretches SegmentSelection::Stretches(const LogSet& logs) const {
  std::vector<Chosen> sorted = chosen;
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.range.begin < b.range.begin;
  });
  LogSet::Stretches stretches(logs.size());
  for (const Chosen& segment : sorted) {
    std::vector<TimeRange>& of_log = stretches[segment.log];
    if (!of_log.empty() && segment.range.begin <= of_log.back().end) {
      of_log.back().end = segment.range.end;
    } else {
      of_log.push_back(segment.range);
    }
  }
  return stretches;
}

SegmentSelection SelectSegments(const Robot& robot,
                                const LinearCalibration& linear,
                                const LinearCalibrationOptions& options,
                                double segment_s, double most_ratio,
                                const LogSet& logs) {
  const InformationScale scale(robot, linear, options);
  std::vector<SegmentInformation> segments =
      InformationBySegment(robot, scale.model, scale.density, segment_s,
                           options.progress, Prepare(logs, linear.preparation));
  const int m = scale.model.size();
  SegmentSelection result;
  result.segment_s = segment_s;
  result.considered = static_cast<int>(segments.size());
  result.total = m;
  MatrixXd all = MatrixXd::Zero(m, m), A = all, scaled = all;
  for (const SegmentInformation& segment : segments) all += segment.A;
  result.rank = scale.Rank(all);
  const double whole = LogDet(scale.Scaled(all));
  while (!segments.empty()) {
    size_t best = 0;
    double most = -1;
    for (size_t k = 0; k < segments.size(); ++k) {
      const double with = LogDet(scaled + scale.Scaled(segments[k].A));
      if (with <= most) continue;
      most = with;
      best = k;
    }
    A += segments[best].A;
    scaled = scale.Scaled(A);
    const int rank = scale.Rank(A);
    result.chosen.push_back({segments[best].log, segments[best].range, rank});
    segments.erase(segments.begin() + static_cast<long>(best));
    result.stddev_ratio = std::exp((whole - most) / (2 * m));
    if (rank >= result.rank && result.stddev_ratio <= most_ratio) break;
  }
  return result;
}

std::string SelectionText(const SegmentSelection& selection,
                          const LogSet& logs) {
  std::string text = Format(
      "selected   %zu of %d segments of %.3g s: %d of %d directions show, as "
      "with all; standard deviations %.2f times\n",
      selection.chosen.size(), selection.considered, selection.segment_s,
      selection.chosen.empty() ? 0 : selection.chosen.back().rank,
      selection.total, selection.stddev_ratio);
  const LogSet::Stretches stretches = selection.Stretches(logs);
  for (int log = 0; log < logs.size(); ++log) {
    for (const TimeRange& range : stretches[log]) {
      text += Format("           %.4g to %.4g s of ", range.begin, range.end) +
              logs.path(log) + "\n";
    }
  }
  return text;
}

nlohmann::json ToJson(const SegmentSelection& selection, const LogSet& logs) {
  nlohmann::json pieces = nlohmann::json::array();
  const LogSet::Stretches stretches = selection.Stretches(logs);
  for (int log = 0; log < logs.size(); ++log) {
    for (const TimeRange& range : stretches[log]) {
      pieces.push_back({{"file", logs.path(log)},
                        {"begin", range.begin},
                        {"end", range.end}});
    }
  }
  return {{"segment", selection.segment_s},
          {"considered", selection.considered},
          {"chosen", selection.chosen.size()},
          {"stddev_ratio", selection.stddev_ratio},
          {"pieces", pieces}};
}

}  // namespace armcal
