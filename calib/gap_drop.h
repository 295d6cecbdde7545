#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/gap_candidates.h"
#include "calib/gap_screen.h"

namespace armcal {

// The screen's candidates beside a set of columns S that is fitted with them.
struct Conditioned {
  Eigen::MatrixXd half;  // G_SS^-1/2 G_S.
  Eigen::VectorXd g;
};

// `gradient`: the screen's, or what it would be for another residual.
Conditioned Condition(const GapScreen& screen, const std::vector<int>& S,
                      const Eigen::VectorXd& gradient);

// Drop of chi^2 when the candidate is added to S. Columns of which nothing is
// left to see have no part in it, nor those that would have the wrong sign
// beside others; 0 where no sign is right.
double Drop(const GapScreen& screen, const Conditioned& c,
            const GapCandidate& candidate);

}  // namespace armcal
