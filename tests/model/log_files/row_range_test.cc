#include "model/log_files/row_range.h"

#include <gtest/gtest.h>

#include "model/log_files/log_reader.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::row_range_test {

TEST(RowRange, EndsBeforeItsEnd) {
  const RowRange range{2, 4};
  EXPECT_FALSE(range.Contains(1));
  EXPECT_TRUE(range.Contains(2));
  EXPECT_TRUE(range.Contains(3));
  EXPECT_FALSE(range.Contains(4));
}

TEST(RowRange, AllSignalsOfALogLoseTheSameRows) {
  Log log;
  log.t = Eigen::VectorXd::LinSpaced(5, 10, 14);
  log.q = log.t;
  log.temperature = 2 * log.t;
  const Log kept = WithoutRows(log, {{11, 12}, {13, 20}}, 10);
  EXPECT_EQ(kept.t, Eigen::Vector2d(10, 12));
  EXPECT_EQ(kept.q, kept.t);
  EXPECT_EQ(kept.temperature, 2 * kept.t);
  EXPECT_EQ(kept.tau.size(), 0);
}

// Whatever the rows of a log are read in, and with the times given for them:
// blocks that lie in a hole altogether are no end of the log.
TEST(RowRange, AReaderLeavesThemOut) {
  const std::string path = WriteFile(
      "t,q1\n0,10\n1,11\n2,12\n3,13\n4,14\n5,15\n6,16\n", "holes.csv");
  LogReaderOptions options;
  options.joint_names = {"joint1"};
  options.need_torque = false;
  options.left_out[path] = {{1, 2}, {3, 6}};
  for (const bool is_timed : {false, true}) {
    if (is_timed) {
      options.sample_times[path] = std::make_shared<const Eigen::VectorXd>(
          Eigen::VectorXd::LinSpaced(7, 0, 3));
    }
    LogReader reader(path, options);
    for (const int block : {1, 2, 100}) {
      Log log;
      std::vector<double> q, t;
      while (reader.Read(block, &log)) {
        q.insert(q.end(), log.q.data(), log.q.data() + log.size());
        t.insert(t.end(), log.t.data(), log.t.data() + log.size());
      }
      EXPECT_EQ(q, (std::vector<double>{10, 12, 16})) << block;
      EXPECT_EQ(t, is_timed ? (std::vector<double>{0, 1, 3})
                            : (std::vector<double>{0, 2, 6}));
      reader.Rewind();
    }
  }
}

// Turns count in rows of the log, whatever it is read in, and with rows left
// out.
TEST(RowRange, AReaderTakesTurnsOut) {
  const std::string path = WriteFile(
      "t,q1,qref1\n0,1,1\n1,2,2\n2,13,3\n3,14,14\n4,5,5\n", "turns.csv");
  LogReaderOptions options;
  options.joint_names = {"joint1"};
  options.need_torque = false;
  options.want_reference = true;
  options.position_turns[path] = {
      {2, 0, 10}, {4, 0, -10}, {3, 0, 10, true}, {4, 0, -10, true}};
  options.left_out[path] = {{1, 2}};
  LogReader reader(path, options);
  for (const int block : {1, 2, 100}) {
    Log log;
    std::vector<double> q, command;
    while (reader.Read(block, &log)) {
      q.insert(q.end(), log.q.data(), log.q.data() + log.size());
      command.insert(command.end(), log.qref.data(),
                     log.qref.data() + log.size());
    }
    EXPECT_EQ(q, (std::vector<double>{1, 3, 4, 5})) << block;
    EXPECT_EQ(command, q) << block;
    reader.Rewind();
  }
}

TEST(RowRange, RowsCountInAllThereAre) {
  const std::vector<RowRange> left_out = {{7, 9}, {2, 4}, {3, 5}};
  const RowRange all = CountedInAll({2, 5}, left_out);  // 5, 6, 9 of 0 1 5 6 9
  EXPECT_EQ(all.begin, 5);
  EXPECT_EQ(all.end, 10);
  EXPECT_EQ(CountedInAll({0, 2}, left_out).end, 2);
}

}  // namespace armcal::row_range_test
