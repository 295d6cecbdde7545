#include "calib/logs/clock_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armcal::clock_text_test {

using testing::HasSubstr;

SampleClock Clock(double rate) {
  SampleClock clock;
  clock.period = .010651;
  clock.period_stddev = 1.5e-5;
  clock.rate = rate;
  clock.wander = .03;
  clock.uneven = true;
  clock.wrong_rate = rate > 1.01;
  return clock;
}

TEST(ClockSentence, OfARateThatIsWrong) {
  EXPECT_THAT(ClockSentence(Clock(1.0227)),
              HasSubstr("rows are 10.651 ms apart in the mean, not 10.415 ms"));
}

// Two means that nothing tells apart are not set against each other.
TEST(ClockSentence, OfARateThatWandersOnly) {
  for (const double rate : {1., 1.0001, .9999}) {
    EXPECT_THAT(ClockSentence(Clock(rate)),
                HasSubstr("their rate is right in the mean, and wanders by "
                          "3.0 %"));
  }
}

}  // namespace armcal::clock_text_test
