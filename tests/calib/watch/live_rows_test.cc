#include "calib/watch/live_rows.h"

#include <gmock/gmock.h>

#include <fstream>

#include "model/text/input_error.h"

namespace armcal::live_rows_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string File(const std::string& text) {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const std::string path =
      testing::TempDir() + "LiveRows_" + info->name() + ".csv";
  std::ofstream(path) << text;
  return path;
}

struct Read {
  explicit Read(const std::string& text) {
    LogReaderOptions options;
    options.joint_names = {"shoulder", "elbow"};
    LiveRows live(File(text), false, 0, options,
                  [this](const std::string& why) { skipped.push_back(why); });
    LiveRow row;
    while (live.Next(&row) == LiveText::Got::kLine) rows.push_back(row);
  }
  std::vector<LiveRow> rows;
  std::vector<std::string> skipped;
};

TEST(LiveRows, HaveTheNamesAndUnitsOfLogs) {
  const Read read(
      "time [ms];tau2;tau1;q1 [deg];elbow/position\n"
      "1700000000500;2;1;180;.5\n1700000000501;4;3;90;.6\n");
  ASSERT_EQ(read.rows.size(), 2);
  EXPECT_NEAR(read.rows[1].t, .001, 1e-12);
  EXPECT_THAT(read.rows[0].tau, ElementsAre(1, 2));
  EXPECT_NEAR(read.rows[0].q[0], M_PI, 1e-12);
  EXPECT_NEAR(read.rows[1].q[1], .6, 1e-12);
}

TEST(LiveRows, BadOnesAreSkippedAndSaid) {
  const Read read(
      "t,q1,q2,tau1,tau2\n0,1,2,3,4\n.001,nan,2,3,4\n.002,1,2,3\n"
      "-1,1,2,3,4\nx,1,2,3,4\n.003,1,2,3,5\n");
  ASSERT_EQ(read.rows.size(), 2);
  EXPECT_EQ(read.rows[1].tau[1], 5);
  EXPECT_THAT(read.skipped,
              ElementsAre(HasSubstr("column q1"), HasSubstr("row 4"),
                          HasSubstr("time runs backwards by 1 s"),
                          HasSubstr("time is no number")));
}

TEST(LiveRows, OtherTablesAreRefused) {
  EXPECT_THAT([] { Read("t,q1,q2,tau1\n0,1,2,3\n"); },
              ThrowsMessage<InputError>(HasSubstr("missing tau2")));
  EXPECT_THAT([] { Read(""); },
              ThrowsMessage<InputError>(HasSubstr("is empty")));
  std::string bad = "t,q1,q2,tau1,tau2\n";
  for (int k = 0; k < 1200; ++k) bad += "0,1,2\n";
  EXPECT_THAT([&] { Read{bad}; },
              ThrowsMessage<InputError>(HasSubstr("could not be used")));
}

}  // namespace armcal::live_rows_test
