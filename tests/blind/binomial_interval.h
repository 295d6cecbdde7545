#pragma once

namespace armcal {

// The exact 95 % interval of a probability of which `hits` of `count` were
// seen (Clopper and Pearson 1934); [0, 1] of nothing.
struct BinomialInterval {
  double low = 0, high = 1;
};
BinomialInterval ClopperPearson(int hits, int count);

}  // namespace armcal
