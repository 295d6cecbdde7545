#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Rows [begin, end) of a column that have one value.
struct EqualRows {
  int begin = 0, end = 0;
  int repeats = 0;  // of the row before, that count
};

// Runs of equal values that have one row at least of those that `count`.
std::vector<EqualRows> RunsOfEqualRows(const Eigen::VectorXd& x,
                                       const std::vector<bool>& counts);

// Those that are too long for chance beside the others, longest first. Of m
// runs of equal values whose lengths are geometrically distributed, P(repeats
// >= r) = p^r, the longest has about log m / -log p repeats. The longest one of
// all others, r2, so tells p = m^(-1/r2), and of runs with r repeats or more
// m p^r = m^(1 - r / r2) are expected: less than e^-nats of those returned.
std::vector<EqualRows> TooLongForChance(std::vector<EqualRows> runs,
                                        double nats);

}  // namespace armcal
