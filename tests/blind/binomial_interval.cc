#include "tests/blind/binomial_interval.h"

#include <boost/math/distributions/binomial.hpp>

namespace armcal {

BinomialInterval ClopperPearson(int hits, int count) {
  using boost::math::binomial_distribution;
  constexpr double kTail = .025;
  if (count == 0) return {};
  return {binomial_distribution<>::find_lower_bound_on_p(count, hits, kTail),
          binomial_distribution<>::find_upper_bound_on_p(count, hits, kTail)};
}

}  // namespace armcal
