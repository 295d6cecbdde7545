#include "model/text/enumeration.h"

#include <gtest/gtest.h>

namespace armcal::enumeration_test {

TEST(Enumeration, IsWrittenAsASentenceHasIt) {
  EXPECT_EQ(Enumeration({}), "");
  EXPECT_EQ(Enumeration({"delay"}), "delay");
  EXPECT_EQ(Enumeration({"delay", "spring"}), "delay and spring");
  EXPECT_EQ(Enumeration({"delay", "spring", "cable"}),
            "delay, spring and cable");
}

}  // namespace armcal::enumeration_test
