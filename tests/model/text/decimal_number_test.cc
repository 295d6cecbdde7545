#include "model/text/decimal_number.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <random>
#include <string>

namespace armcal::decimal_number_test {

// The same value to the bit, the same end and the same verdict as the standard
// library's.
void ExpectSame(const std::string& text) {
  double ours = 7, theirs = 7;
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const auto a = ParseDecimalNumber(begin, end, &ours);
  const auto b = std::from_chars(begin, end, theirs);
  EXPECT_EQ(a.ptr - begin, b.ptr - begin) << text;
  EXPECT_EQ(a.ec, b.ec) << text;
  EXPECT_EQ(std::memcmp(&ours, &theirs, sizeof(ours)), 0)
      << text << " " << ours << " " << theirs;
}

TEST(ParseDecimalNumber, IsTheStandardLibrarys) {
  for (const char* text : {"0",
                           "-0",
                           "1",
                           "-1.5",
                           "12345678",
                           ".5",
                           "5.",
                           "-.25",
                           "12345678.12345678",
                           "00001",
                           "0.1",
                           "1e5",
                           "1e-5",
                           "-2.5E+03",
                           "1e22",
                           "1e23",
                           "1e-22",
                           "1e-23",
                           "123456789012345",
                           "1234567890123456",
                           "9007199254740993",
                           "0.000001234567890123456789",
                           "1e400",
                           "1e-400",
                           "1e99999",
                           "1e99999999999",
                           "nan",
                           "inf",
                           "-inf",
                           "-",
                           "",
                           ".",
                           "e5",
                           "1e",
                           "1e+",
                           "1e-x",
                           "1.2.3",
                           "1,5",
                           "1 ",
                           "+1",
                           "0x10",
                           "1234567a",
                           "1234567/",
                           "1234567:",
                           "12345678e2",
                           "--1",
                           "1e5e5",
                           "3.14159,2.7"}) {
    ExpectSame(text);
  }
}

TEST(ParseDecimalNumber, RandomNumbersAsPrintfWritesThem) {
  std::mt19937_64 random(5);
  char text[64];
  for (int k = 0; k < 200000; ++k) {
    const double x = std::ldexp(static_cast<double>(random()) / 1e19 - .9,
                                static_cast<int>(random() % 120) - 60);
    const char* const forms[] = {"%.9g", "%.17g", "%.6f", "%.15g", "%.3e"};
    std::snprintf(text, sizeof(text), forms[k % 5], x);
    ExpectSame(text);
  }
}

}  // namespace armcal::decimal_number_test
