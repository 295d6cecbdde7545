#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace armcal {

// Over how many neighbours a series in time is correlated: the integrated
// autocorrelation time 1 + 2 sum rho_k of its midranks (for which neither the
// scale nor an infinite value counts), summed as Geyer (1992, initial positive
// sequence) does; in samples, at least 1. Independent values have 1, values in
// runs of L have L.
double CorrelationTime(const std::vector<double>& series);

// Blocks of a series of `size` samples: two correlation times, which see five
// sixths of a mean's variance where the series comes in runs, and at least the
// cube root of `size`; at most `size`.
int BootstrapBlock(int size, double correlation_time);

// The interval of 95 % of a statistic of a series: the bootstrap with circular
// moving blocks (Kuensch 1989; Politis & Romano 1992) of this length, 2000
// draws, its percentiles expanded for the number of blocks, as Student's t is
// wider than the normal distribution (Hesterberg 2015). At least two blocks.
// `statistic` is given the indices that were drawn; where it is NaN it counts
// as infinite.
struct BootstrapInterval {
  double low, high;
};
BootstrapInterval BlockBootstrap(
    int size, int block, std::uint64_t seed,
    const std::function<double(const std::vector<int>&)>& statistic);

}  // namespace armcal
