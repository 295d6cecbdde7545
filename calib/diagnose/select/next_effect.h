#pragma once

#include <limits>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/regression.h"
#include "calib/diagnose/select/selection_options.h"

namespace armcal {

// What is added next to a set of effects, `smaller` being its columns, and its
// odds less its penalty; -1: none is above the threshold.
struct NextEffect {
  int candidate = -1;
  double odds = -std::numeric_limits<double>::infinity();
  // The largest odds of all that were compared, whatever they explain, and
  // whose these are.
  double best_odds = -std::numeric_limits<double>::infinity();
  int best = -1;
};
NextEffect NextOf(const GapRegression& regression,
                  const std::vector<GapCandidate>& candidates,
                  const SelectionOptions& options, const std::vector<int>& set,
                  const GapScreen& smaller);

// 2 log of the odds of a set with these candidates and columns (of one joint
// each) as well against it alone (`smaller`), less their penalties.
double ScoreTogether(const GapRegression& regression,
                     const std::vector<GapCandidate>& candidates,
                     const std::vector<int>& set, const GapScreen& smaller,
                     const std::vector<int>& together,
                     const std::vector<JointRows>& columns = {});

}  // namespace armcal
