#include "calib/numerics/readable_sum.h"

#include <gtest/gtest.h>

namespace armcal::readable_sum_test {

TEST(ReadableSumTest, LeavesRoundingOut) {
  EXPECT_EQ(ReadableSum("Izz[1] - 2.405e-10*hx[1] - 3.802e-10*hy[1] + "
                        "armature[1]"),
            "Izz[1] + armature[1]");
  EXPECT_EQ(ReadableSum("1e-12*hx[1] - Izz[1] + 0.2*m[2]"),
            "-Izz[1] + 0.2*m[2]");
}

TEST(ReadableSumTest, KeepsWhatCounts) {
  // Names that hold a minus, a length as a factor, and short lengths.
  for (const char* name :
       {"(Ixx-Iyy)/2[2] + 0.06*hx[3] - 1.5e-05*m[3]", "a2*hx[3] + a2*m[4]",
        "viscous[1]", "Izz[2] + armature[2]", ""}) {
    EXPECT_EQ(ReadableSum(name), name);
  }
}

TEST(ReadableSumTest, PutsOnlySumsInBrackets) {
  EXPECT_EQ(InBrackets("(Ixx-Iyy)/2[2]"), "(Ixx-Iyy)/2[2]");
  EXPECT_EQ(InBrackets("Izz[2] + armature[2]"), "(Izz[2] + armature[2])");
}

}  // namespace armcal::readable_sum_test
