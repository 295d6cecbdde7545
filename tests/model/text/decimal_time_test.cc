#include "model/text/decimal_time.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace armcal::decimal_time_test {

DecimalTime Parse(const std::string& text, int unit_decimals = 0) {
  DecimalTime time;
  EXPECT_TRUE(ParseDecimalTime(text, unit_decimals, &time)) << text;
  return time;
}

double Between(const std::string& earlier, const std::string& later) {
  return Difference(Parse(later), Parse(earlier));
}

TEST(DecimalTime, KeepsNanosecondsOfEpochTimes) {
  // As doubles these two are equal.
  EXPECT_EQ(Between("1700000000.123456788", "1700000000.123456789"), 1e-9);
  EXPECT_EQ(Between("1699999999.999999999", "1700000000.000000001"), 2e-9);
  EXPECT_EQ(Difference(Parse("1700000000123456789", 9),
                       Parse("1700000000123456788", 9)),
            1e-9);
}

TEST(DecimalTime, EveryWayOfWritingIsTheSameTime) {
  const DecimalTime time = Parse("1234.5");
  for (const char* text : {"1234.50", "1.2345e3", "1.2345e+03", "1.2345E3",
                           "12345e-1", "0012345.000e-1", "123450000000e-8",
                           "1234.500000000000000000000000000000000000000"}) {
    EXPECT_EQ(Difference(Parse(text), time), 0) << text;
  }
  EXPECT_EQ(Difference(Parse("1234500", 3), time), 0);
  EXPECT_EQ(Difference(Parse("1.2345e9", 6), time), 0);
  EXPECT_EQ(Difference(Parse("1234500000000", 9), time), 0);
}

TEST(DecimalTime, IsTheNearestDoubleForLogsThatStartAtZero) {
  std::mt19937 generator(1);
  std::uniform_int_distribution<long> microseconds(0, 100'000'000'000);
  const DecimalTime zero = Parse("0");
  for (int i = 0; i < 1000; ++i) {
    std::string text = std::to_string(microseconds(generator) + 1'000'000);
    text.insert(text.size() - 6, ".");
    EXPECT_EQ(Difference(Parse(text), zero), std::stod(text)) << text;
  }
}

TEST(DecimalTime, SignsAndMagnitudes) {
  EXPECT_EQ(Between("-0.5", "0.25"), 0.75);
  EXPECT_EQ(Between("0.25", "-0.5"), -0.75);
  EXPECT_EQ(Between("0", "1e-30"), 1e-30);
  EXPECT_LT(Between("1e-30", "0"), 0);
  EXPECT_EQ(Between("1e-30", "1700000000"), 1.7e9);
  EXPECT_EQ(Between("0e500", "5."), 5);
  EXPECT_EQ(Between("0", ".5"), 0.5);
  EXPECT_EQ(Between("9.99999999999999999", "10"), 1e-17);
}

TEST(DecimalTime, RefusesWhatIsNoTime) {
  for (const char* text : {"",
                           "-",
                           ".",
                           "e5",
                           "1e",
                           "1e+",
                           "1e+-3",
                           "1e5x",
                           "1,5",
                           "+1",
                           " 1",
                           "1 ",
                           "nan",
                           "inf",
                           "0x10",
                           "1.2.3",
                           "--1",
                           "12abc",
                           "1e400",
                           "1e19",
                           "99999999999999999999",
                           "1e99999999999"}) {
    DecimalTime time;
    EXPECT_FALSE(ParseDecimalTime(text, 0, &time)) << text;
  }
}

}  // namespace armcal::decimal_time_test
