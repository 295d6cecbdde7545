#include "model/text/input_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::input_text_test {

TEST(ParseNumber, TakesAllOfTheTextOrNothing) {
  EXPECT_EQ(ParseNumber("0.1"), 0.1);
  EXPECT_EQ(ParseNumber(" -2e-3\t"), -2e-3);
  EXPECT_EQ(ParseNumber("+1"), 1);
  EXPECT_EQ(ParseNumber("1."), 1);
  EXPECT_EQ(ParseNumber("+.5"), .5);
  EXPECT_TRUE(std::isnan(*ParseNumber("nan")));
  for (const char* text : {"", " ", "2kg", "2,5", "1 2", "+-1", "++1", "+",
                           "0x1p3", "1e", "--1", "1e400", "1d3", "pi/2"}) {
    EXPECT_EQ(ParseNumber(text), std::nullopt) << text;
  }
}

TEST(OneLine, FitsIntoAMessage) {
  EXPECT_EQ(OneLine("a\nb\x1b[2J"), "a b [2J");
  EXPECT_EQ(OneLine(std::string(81, 'x')), std::string(80, 'x') + "...");
  // 79 bytes and a character of two: not cut in two.
  EXPECT_EQ(OneLine(std::string(79, 'x') + "\xC3\xA9"),
            std::string(79, 'x') + "...");
  EXPECT_EQ(OneLine("\xC3\xA9"), "\xC3\xA9");
}

TEST(JoinNames, ShortensLongLists) {
  EXPECT_EQ(JoinNames({}), "");
  EXPECT_EQ(JoinNames({"a", "b"}), "a, b");
  const std::string many = JoinNames(std::vector<std::string>(47, "a"));
  EXPECT_EQ(many.substr(many.size() - 18), "a, a, a and 7 more");
}

TEST(SplitWords, SplitsAtAnyBlanks) {
  EXPECT_TRUE(SplitWords(" \n").empty());
  EXPECT_EQ(SplitWords(" 1  2\n3 "),
            (std::vector<std::string_view>{"1", "2", "3"}));
}

}  // namespace armcal::input_text_test
