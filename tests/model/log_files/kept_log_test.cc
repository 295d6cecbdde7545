#include "model/log_files/kept_log.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/fixtures/temp_file.h"

namespace armcal::kept_log_test {

LogReaderOptions OneJoint() {
  LogReaderOptions options;
  options.joint_names = {"joint1"};
  return options;
}

std::string WriteRows(int rows) {
  std::string text = "t,q1,tau1\n";
  for (int k = 0; k < rows; ++k) {
    text += std::to_string(.001 * k) + "," + std::to_string(.5 * k) + "," +
            std::to_string(-2 * k) + "\n";
  }
  return WriteFile(text);
}

// Numbers 0, 1, 2 .. one after the other, whatever the blocks.
void ExpectAllRows(KeptLog* log, int rows) {
  int next = 0;
  while (const Log* block = log->Next()) {
    EXPECT_EQ(block->first_row, next + 2);
    for (int k = 0; k < block->size(); ++k, ++next) {
      ASSERT_DOUBLE_EQ(block->q(k, 0), .5 * next);
      ASSERT_DOUBLE_EQ(block->tau(k, 0), -2 * next);
    }
  }
  EXPECT_EQ(next, rows);
  EXPECT_EQ(log->Next(), nullptr);
}

constexpr int kRows = 10000;
constexpr std::size_t kEnough = kRows * 3 * sizeof(double) + 10000;

TEST(KeptLog, NeedsItsFileOnce) {
  const std::string path = WriteRows(kRows);
  KeptLog log(path, OneJoint(), std::make_shared<MemoryBudget>(kEnough));
  ExpectAllRows(&log, kRows);
  log.Rewind();
  std::remove(path.c_str());
  for (int pass = 0; pass < 2; ++pass) {
    ExpectAllRows(&log, kRows);
    log.Rewind();
  }
}

TEST(KeptLog, IsReadAgainWhereItDoesNotFit) {
  const std::string path = WriteRows(kRows);
  const auto budget = std::make_shared<MemoryBudget>(kEnough / 2);
  KeptLog log(path, OneJoint(), budget);
  for (int pass = 0; pass < 3; ++pass) {
    ExpectAllRows(&log, kRows);
    log.Rewind();
    EXPECT_TRUE(budget->Take(kEnough / 2)) << "memory that nothing is kept in";
    budget->Give(kEnough / 2);
  }
}

TEST(KeptLog, APassThatIsLeftCountsForNothing) {
  KeptLog log(WriteRows(kRows), OneJoint(),
              std::make_shared<MemoryBudget>(2 * kEnough));
  ASSERT_NE(log.Next(), nullptr);
  log.Rewind();
  ExpectAllRows(&log, kRows);
  log.Rewind();
  ASSERT_NE(log.Next(), nullptr);
  log.Rewind();
  ExpectAllRows(&log, kRows);
}

TEST(KeptLog, GivesItsMemoryBack) {
  const auto budget = std::make_shared<MemoryBudget>(kEnough);
  {
    KeptLog log(WriteRows(kRows), OneJoint(), budget);
    ExpectAllRows(&log, kRows);
    EXPECT_FALSE(budget->Take(kEnough));
    KeptLog moved = std::move(log);
    moved.Rewind();
    ExpectAllRows(&moved, kRows);
  }
  EXPECT_TRUE(budget->Take(kEnough));
}

}  // namespace armcal::kept_log_test
