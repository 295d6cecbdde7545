#include "model/text/option_name.h"

#include <gtest/gtest.h>

namespace armcal {
namespace {

TEST(OptionName, IsTheMemberUntilAProgramSaysOtherwise) {
  EXPECT_EQ(OptionName("bandwidth"), "`bandwidth`");
  SetOptionPrefix("--");
  EXPECT_EQ(OptionName("bandwidth"), "--bandwidth");
}

}  // namespace
}  // namespace armcal
