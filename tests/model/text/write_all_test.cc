#include "model/text/write_all.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>

namespace armcal::write_all_test {

void DoNothing(int) {}

// Signals every millisecond, for which a write gives back what it has written
// so far, or that it was interrupted.
class Interruptions {
 public:
  Interruptions() {
    struct sigaction action = {};
    action.sa_handler = &DoNothing;
    sigaction(SIGALRM, &action, nullptr);
    Repeat(1000);
  }
  ~Interruptions() { Repeat(0); }

 private:
  static void Repeat(int microseconds) {
    const itimerval timer = {{0, microseconds}, {0, microseconds}};
    setitimer(ITIMER_REAL, &timer, nullptr);
  }
};

// A pipe holds 64 kB, which are read a little at a time.
TEST(WriteAll, InAsManyCallsAsItTakes) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  std::string sent(1 << 20, 'x');
  for (size_t k = 0; k < sent.size(); k += 997) {
    sent[k] = static_cast<char>('a' + k % 26);
  }
  std::string received;
  std::thread reader([&] {
    std::string block(30000, 0);
    while (true) {
      const ssize_t size = read(ends[0], block.data(), block.size());
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) break;
      received.append(block, 0, static_cast<size_t>(size));
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  {
    const Interruptions interruptions;
    EXPECT_TRUE(WriteAll(ends[1], sent.data(), sent.size()));
  }
  close(ends[1]);
  reader.join();
  close(ends[0]);
  EXPECT_TRUE(received == sent);
}

TEST(WriteAll, SaysWhyItCannot) {
  const int full = open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  EXPECT_FALSE(WriteAll(full, "x", 1));
  EXPECT_EQ(errno, ENOSPC);
  EXPECT_TRUE(WriteAll(full, "x", 0));
  close(full);
}

}  // namespace armcal::write_all_test
