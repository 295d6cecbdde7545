// What a calibration of poses holds, as people read it.

#include "calib/poses/held_text.h"

#include <gtest/gtest.h>

namespace armcal::held_text_test {

const std::string kAlike = " cannot be told from the parameters before it";

TEST(HeldText, HasFewAsTheyAre) {
  EXPECT_EQ(HeldText({}), "");
  EXPECT_EQ(HeldText({"all lengths: an inclinometer sees directions alone",
                      "a.d" + kAlike, "b.d" + kAlike}),
            "held       all lengths: an inclinometer sees directions alone\n"
            "held       a.d" +
                kAlike + "\nheld       b.d" + kAlike + "\n");
}

// By link, in the order in which each comes first.
TEST(HeldText, HasManyThatAreAlikeOnce) {
  EXPECT_EQ(HeldText({"arm.1.theta" + kAlike, "b.theta" + kAlike,
                      "c.a is not seen by these poses", "arm.1.x" + kAlike,
                      "b.yaw" + kAlike}),
            "held       4 parameters, each of which" + kAlike +
                ":\n"
                "           arm.1.theta .x\n"
                "           b.theta .yaw\n"
                "held       c.a is not seen by these poses\n");
}

}  // namespace armcal::held_text_test
