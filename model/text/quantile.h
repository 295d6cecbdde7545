#pragma once

namespace armcal {

// The element at `rank` (from 0) if the `count` numbers x, none of them
// negative or NaN, were sorted. Goes through them twice.
double NonnegativeAtRank(const double* x, long count, long rank);

}  // namespace armcal
