#include "model/text/format.h"

#include <gtest/gtest.h>

namespace armcal::format_test {

TEST(Format, OfAnyLength) {
  EXPECT_EQ(Format("%.2f %s %d", 1.5, "m", 3), "1.50 m 3");
  EXPECT_EQ(Format("%s", ""), "");
  const std::string text(5000, 'x');
  EXPECT_EQ(Format("%s!", text.c_str()), text + "!");
}

}  // namespace armcal::format_test
