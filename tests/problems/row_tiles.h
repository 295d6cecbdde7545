#pragma once

// Rows of a motion that is cut into cores, as TrajectoryReader cuts a log.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "problems/identification_rows.h"
#include "problems/make_rows.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal {

inline std::vector<IdentificationRow> Rows(const Trajectory& trajectory,
                                           const RowOptions& options,
                                           MotionRegressor* regressor) {
  std::vector<IdentificationRow> rows;
  ForEachRow(trajectory, options, regressor,
             [&](const IdentificationRow& row) { rows.push_back(row); });
  return rows;
}

// Cut at `borders`, each core with `margin` samples either side, the arm's
// motion has the rows of the whole, each once. Returns their number.
inline size_t ExpectRowsTile(const ModelParameters& parameters,
                             const RowOptions& options, double dt, int margin,
                             const std::vector<int>& borders,
                             double tolerance) {
  const TwoLinkArm arm;
  const int n = borders.back();
  MotionRegressor whole_regressor(parameters), regressor(parameters);
  const auto whole = Rows(arm.Record(dt, n), options, &whole_regressor);
  std::vector<IdentificationRow> parts;
  for (size_t i = 0; i + 1 < borders.size(); ++i) {
    const int begin = std::max(0, borders[i] - margin);
    const int end = std::min(n, borders[i + 1] + margin);
    Trajectory t = arm.Record(dt, end - begin, begin);
    t.core_begin = borders[i] - begin;
    t.core_end = borders[i + 1] - begin;
    const auto rows = Rows(t, options, &regressor);
    parts.insert(parts.end(), rows.begin(), rows.end());
  }
  EXPECT_EQ(parts.size(), whole.size());
  for (size_t k = 0; k < std::min(parts.size(), whole.size()); ++k) {
    EXPECT_NEAR(parts[k].time, whole[k].time, 1e-9);
    EXPECT_LT((parts[k].U - whole[k].U).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LT((parts[k].Y - whole[k].Y).cwiseAbs().maxCoeff(), tolerance);
  }
  return whole.size();
}

}  // namespace armcal
