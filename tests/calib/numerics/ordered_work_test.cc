#include "calib/numerics/ordered_work.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "calib/numerics/thread_limit.h"

namespace armcal::ordered_work_test {

TEST(ThreadLimit, HoldsAsLongAsItLives) {
  const int all = ThreadLimit::Active();
  {
    const ThreadLimit three(3);
    EXPECT_EQ(ThreadLimit::Active(), 3);
    const ThreadLimit one(1), as_before(0);
    EXPECT_EQ(ThreadLimit::Active(), 1);
    EXPECT_EQ(OrderedWork().num_slots(), 1);
  }
  EXPECT_EQ(ThreadLimit::Active(), all);
}

// Each thread has its own, whatever the others do meanwhile.
TEST(WithThreads, HoldsForItsThreadAlone) {
  const int all = ThreadLimit::Active();
  WithThreads(1, [&] {
    EXPECT_EQ(OrderedWork().num_slots(), 1);
    std::thread other([&] {
      EXPECT_EQ(ThreadLimit::Active(), all);
      WithThreads(3, [&] {
        EXPECT_EQ(ThreadLimit::Active(), std::min(3, all));
        WithThreads(0, [&] { EXPECT_EQ(ThreadLimit::Active(), all); });
        EXPECT_EQ(ThreadLimit::Active(), std::min(3, all));
      });
    });
    other.join();
    EXPECT_EQ(ThreadLimit::Active(), 1);
  });
  EXPECT_EQ(ThreadLimit::Active(), all);
}

TEST(WithThreads, DoesItsWorkInTheCallingThread) {
  const std::thread::id here = std::this_thread::get_id();
  for (int k = 0; k < 100; ++k) {
    WithThreads(1 + k % 3,
                [&] { EXPECT_EQ(std::this_thread::get_id(), here); });
  }
  EXPECT_THROW(WithThreads(2, [] { throw std::out_of_range("work"); }),
               std::out_of_range);
  EXPECT_GE(ThreadLimit::Active(), 1);
}

// Every other task takes long, so that its followers are done before it.
TEST(OrderedWork, FinishesInOrderWhateverIsDoneFirst) {
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const OrderedWork work;
    std::vector<int> task_of(work.num_slots(), -1), finished;
    std::atomic<int> in_work = 0, overtaken = 0, done = 0;
    int next = 0;
    work.Run(
        [&](int slot) {
          if (next == 20) return false;
          EXPECT_EQ(task_of[slot], -1) << "in use";
          task_of[slot] = next++;
          return true;
        },
        [&](int slot) {
          EXPECT_LE(++in_work, threads);
          if (task_of[slot] % 2 == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(4));
          }
          if (done++ < task_of[slot]) ++overtaken;
          --in_work;
        },
        [&](int slot) {
          finished.push_back(task_of[slot]);
          task_of[slot] = -1;
        });
    ASSERT_EQ(finished.size(), 20);
    for (int k = 0; k < 20; ++k) EXPECT_EQ(finished[k], k);
    EXPECT_EQ(overtaken > 0, threads > 1);
  }
}

TEST(OrderedWork, PassesOnWhatATaskThrows) {
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    int tasks = 0;
    EXPECT_THROW(OrderedWork().Run([&](int) { return tasks++ < 9; },
                                   [](int) { throw std::runtime_error("no"); },
                                   [](int) {}),
                 std::runtime_error);
  }
}

}  // namespace armcal::ordered_work_test
