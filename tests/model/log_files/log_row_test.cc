#include "model/log_files/log_row.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/log_files/log_reader.h"
#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::log_row_test {

struct BadRows {
  const char* rows;  // after the header t;q1;q2;note
  const char* message;
};

const BadRows kBadRows[] = {
    {"", ": the log has a header and no rows"},
    {"\n \n", ": the log has a header and no rows"},
    {"0;1;2",
     ": row 2: found '3 fields': expected 4 as in the header; the "
     "file ends inside this row, delete it"},
    {"0;1;2\n", ": row 2: found '3 fields': expected 4 as in the header"},
    {"0;1;2;;\n", ": row 2: found '5 fields': expected 4 as in the header"},
    {"0\n", ": row 2: found '1 field': expected 4 as in the header"},
    {"0,1,2,\n", ": row 2: found '1 field': expected 4 as in the header"},
    {"0;1;2;\n0;x\n", ": row 3: found '2 fields': expected 4 as in the header"},
    {"\n0;1;2;\n", ": row 2: the row is empty, and more rows follow"},
    {"0;1;2;\n\n \n1;1;2;\n",
     ": row 3: the row is empty, and more rows follow"},
    {"0;;2;\n", ", column q1: the field is empty, expected a number"},
    {"0;1;  ;\n", ", column q2: the field is empty, expected a number"},
    {";1;2;\n", ", column t: the field is empty, expected a number"},
    {"0;nan;2;\n", ", column q1: found 'nan': expected a finite number"},
    {"0;1;NaN;\n", ", column q2: found 'NaN': expected a finite number"},
    {"0;inf;2;\n", ", column q1: found 'inf': expected a finite number"},
    {"0;-Infinity;2;\n",
     ", column q1: found '-Infinity': expected a finite number"},
    {"0;1e400;2;\n", ", column q1: found '1e400': expected a finite number"},
    {"0;12abc;2;\n", ", column q1: found '12abc': expected a finite number"},
    {"0;1 2;2;\n", ", column q1: found '1 2': expected a finite number"},
    {"0;0x10;2;\n", ", column q1: found '0x10': expected a finite number"},
    {"0;1.2.3;2;\n", ", column q1: found '1.2.3': expected a finite number"},
    {"0;--1;2;\n", ", column q1: found '--1': expected a finite number"},
    {"0;+-1;2;\n", ", column q1: found '+-1': expected a finite number"},
    {"0;+;2;\n", ", column q1: found '+': expected a finite number"},
    {"0;-;2;\n", ", column q1: found '-': expected a finite number"},
    {"0;1e;2;\n", ", column q1: found '1e': expected a finite number"},
    {"0;\"1\";2;\n", ", column q1: found '\"1\"': expected a finite number"},
    {"0;1\t;2;\n", ", column q1: found '1 ': expected a finite number"},
    {"0;1;1,5;\n",
     ", column q2: found '1,5': expected a finite number with a "
     "decimal point, not a comma"},
    {"0,5;1;2;\n",
     ", column t: found '0,5': expected a finite number with a "
     "decimal point, not a comma"},
    {"nan;1;2;\n", ", column t: found 'nan': expected a finite number"},
    {"1e400;1;2;\n", ", column t: found '1e400': expected a finite number"},
    {"12:30:01;1;2;\n",
     ", column t: found '12:30:01': expected a finite number"},
    {"0.6;1;2;\n0.5;1;2;\n",
     ": row 3, column t: found '0.5': time runs "
     "backwards, the row before has 0.6"},
    {"-1;1;2;\n-1.000000000000000001;1;2;\n",
     ": row 3, column t: found '-1.000000000000000001': time runs backwards, "
     "the row before has -1"},
};

TEST(LogRow, IsRefusedWithPlaceAndReason) {
  LogReaderOptions options;
  options.joint_names = {"shoulder", "elbow"};
  options.need_torque = false;
  for (const BadRows& bad : kBadRows) {
    const std::string text = std::string("t;q1;q2;note\n") + bad.rows;
    const std::string place = bad.message[0] == ',' ? ": row 2" : "";
    for (const std::string& bytes : {text, Gzip(text)}) {
      for (int max_rows : {1, 100}) {
        const std::string path = WriteFile(bytes);
        const auto read = [&] {
          LogReader reader(path, options);
          Log log;
          while (reader.Read(max_rows, &log)) continue;
        };
        EXPECT_EQ(MessageOf<InputError>(path, read),
                  "FILE" + place + bad.message);
      }
    }
  }
}

TEST(LogRow, WalksToTheUsedFieldsOnly) {
  const LogColumns columns("log.csv", "a,q2,b,c,t,q1,d", {"one", "two"});
  LogRow row("log.csv", columns, 4);
  EXPECT_EQ(row.Use(columns.Find(Signal::kPosition)), 0);
  ASSERT_EQ(row.width(), 2);
  double values[2] = {};
  std::string_view time;
  ASSERT_TRUE(row.Parse(",2,,x, 7 ,1,", values, &time));
  EXPECT_EQ(values[0], 1);
  EXPECT_EQ(values[1], 2);
  EXPECT_EQ(time, " 7 ");
  EXPECT_TRUE(row.Parse("a,+2 ,,,, 1,d", values, &time));
  EXPECT_EQ(time, "");
  EXPECT_FALSE(row.Parse("a,2,,,7,1", values, &time));
  EXPECT_FALSE(row.Parse("a,2,,,7,1,,", values, &time));
  EXPECT_FALSE(row.Parse("a,2,,,7", values, &time));
  EXPECT_FALSE(row.Parse("a,,,,7,1,", values, &time));
  EXPECT_FALSE(row.Parse("", values, &time));
}

// Threads may meet the later ones first.
TEST(LogRow, TheFirstOfManyBadRowsIsNamed) {
  std::string text = "t,q1,q2\n";
  for (int k = 0; k < 20000; ++k) {
    const bool bad = k == 1700 || k == 2100 || k > 9000;
    text +=
        std::to_string(k) + (bad ? ",x" + std::to_string(k) : ",1") + ",2\n";
  }
  text[text.size() - 5] = '\0';
  LogReaderOptions options;
  options.joint_names = {"shoulder", "elbow"};
  options.need_torque = false;
  for (const std::string& bytes : {text, Gzip(text)}) {
    const std::string path = WriteFile(bytes);
    LogReader reader(path, options);
    try {
      Log log;
      while (reader.Read(100000, &log)) {
      }
      ADD_FAILURE() << "nothing is refused";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("row 1702, column q1"));
      EXPECT_THAT(error.what(), testing::HasSubstr("x1700"));
    }
  }
}

}  // namespace armcal::log_row_test
