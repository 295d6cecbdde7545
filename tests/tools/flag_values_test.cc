#include "tools/flag_values.h"

#include <gflags/gflags.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tools/usage_error.h"

DEFINE_double(tried_double, 0.1, "");
DEFINE_int32(tried_int32, -3, "");
DEFINE_uint64(tried_uint64, 7, "");
DEFINE_bool(tried_bool, true, "");
DEFINE_string(tried_string, "default", "");

namespace armcal::flag_values_test {

const std::vector<std::string> kNames = {"tried_string", "tried_double",
                                         "tried_int32", "tried_uint64",
                                         "tried_bool"};

// What gflags makes of a text; empty: it refuses it.
std::string ByGflags(const std::string& name, const std::string& text) {
  const gflags::FlagSaver as_before;
  if (gflags::SetCommandLineOption(name.c_str(), text.c_str()).empty()) {
    return "";
  }
  return "--" + name + "=" +
         gflags::GetCommandLineFlagInfoOrDie(name.c_str()).current_value;
}

std::string ByUs(const std::string& name, const std::string& text) {
  try {
    return FlagValues(kNames, {{name, text, true, ""}}).AsTyped().at(0);
  } catch (const UsageError&) {
    return "";
  }
}

TEST(FlagValues, TakesAndTypesWhatGflagsDoes) {
  for (const std::string text : {"0",
                                 "-0",
                                 "1",
                                 "0.3",
                                 "1e3",
                                 "-17",
                                 "+5",
                                 " 5",
                                 "5 ",
                                 "",
                                 " ",
                                 "0x1F",
                                 "0X1f",
                                 "-0x10",
                                 "1e400",
                                 "1e-320",
                                 "nan",
                                 "-inf",
                                 "0x1p3",
                                 "010",
                                 "08",
                                 "true",
                                 "TRUE",
                                 "t",
                                 "Yes",
                                 "no",
                                 "F",
                                 "truth",
                                 "-1",
                                 " -1",
                                 ".5",
                                 "5.",
                                 "1,5",
                                 "12abc",
                                 "--5",
                                 "2147483647",
                                 "2e0",
                                 "999",
                                 "-2147483648",
                                 "2147483648",
                                 "-2147483649",
                                 "18446744073709551615",
                                 "18446744073709551616",
                                 "9223372036854775808"}) {
    for (const std::string& name : kNames) {
      EXPECT_EQ(ByUs(name, text), ByGflags(name, text))
          << name << " of '" << text << "'";
    }
  }
}

TEST(FlagValues, AreTheDefaultsUnlessGiven) {
  const FlagValues none(kNames, {});
  EXPECT_EQ(none.Text("tried_string"), "default");
  EXPECT_EQ(none.Number("tried_double"), 0.1);
  EXPECT_EQ(none.Whole("tried_int32"), -3);
  EXPECT_EQ(none.Natural("tried_uint64"), 7);
  EXPECT_TRUE(none.Switch("tried_bool"));
  EXPECT_TRUE(none.IsDefault("tried_double"));
  EXPECT_TRUE(none.AsTyped().empty());
}

// In the order of the command's flags, the later of two values.
TEST(FlagValues, AreAsTyped) {
  const FlagValues given(kNames, {{"tried_bool", "no", true, ""},
                                  {"tried_double", "0.1", true, ""},
                                  {"tried_string", "a b", true, ""},
                                  {"tried_string", "c", true, ""}});
  EXPECT_EQ(given.AsTyped(),
            (std::vector<std::string>{"--tried_string=c",
                                      "--tried_double=0.10000000000000001",
                                      "--tried_bool=false"}));
  EXPECT_FALSE(given.IsDefault("tried_double")) << "0.1 is the default, but";
  EXPECT_FALSE(given.Switch("tried_bool"));
  EXPECT_TRUE(given.IsDefault("tried_int32"));
}

// Two sets of values do not know of each other, nor of gflags'.
TEST(FlagValues, AreNobodyElses) {
  const FlagValues one(kNames, {{"tried_double", "1", true, ""}});
  const FlagValues two(kNames, {{"tried_double", "2", true, ""}});
  const gflags::FlagSaver as_before;
  FLAGS_tried_double = 3;
  FLAGS_tried_int32 = 3;
  EXPECT_EQ(one.Number("tried_double"), 1);
  EXPECT_EQ(two.Number("tried_double"), 2);
  EXPECT_EQ(two.Whole("tried_int32"), -3);
}

TEST(FlagValues, RefusalsNameThePlace) {
  try {
    FlagValues(kNames, {{"tried_int32", "x", true, "run.flags: line 3: "}});
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "run.flags: line 3: --tried_int32: found 'x', expected a "
                 "whole number");
  }
}

}  // namespace armcal::flag_values_test
