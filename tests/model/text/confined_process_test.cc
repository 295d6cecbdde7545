#include "model/text/confined_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::confined_process_test {

constexpr std::uint64_t kMemory = 64 << 20;

TEST(ConfinedProcess, MakesWhatItIsAsked) {
  const std::string large(3 << 20, 'x');
  EXPECT_EQ(MakeConfined(kMemory, [&] { return large + "y"; })->made,
            large + "y");
  EXPECT_EQ(MakeConfined(kMemory, [] { return std::string(); })->made, "");
  const auto refused = MakeConfined(kMemory, []() -> std::string {
    throw InputError("file", "", "7", "expected 8");
  });
  EXPECT_EQ(refused->refusal, "file: found '7': expected 8");
}

TEST(ConfinedProcess, TakesNoMoreMemoryThanItMay) {
  const auto take = [](size_t bytes) {
    return MakeConfined(kMemory, [=] {
      return std::to_string(std::string(bytes, 'x').size());
    });
  };
  EXPECT_TRUE(take(kMemory / 2));
  EXPECT_FALSE(take(2 * kMemory));
}

TEST(ConfinedProcess, DiesAlone) {
  EXPECT_FALSE(MakeConfined(kMemory, []() -> std::string { std::abort(); }));
  EXPECT_FALSE(MakeConfined(kMemory, []() -> std::string { _exit(0); }));
  EXPECT_FALSE(MakeConfined(kMemory, []() -> std::string {
    std::raise(SIGKILL);
    std::abort();
  }));
}

TEST(ConfinedProcess, ReadsButCannotWriteRunOrConnect) {
  const std::string path = WriteFile("as it was");
  const auto made = MakeConfined(kMemory, [&] {
    std::ostringstream said;
    const auto tell = [&](const char* what, bool done) {
      said << what
           << (done             ? " done"
               : errno == EPERM ? " denied"
                                : " failed")
           << "\n";
    };
    std::string text;
    tell("read", static_cast<bool>(std::getline(std::ifstream(path), text)));
    said << text << "\n";
    tell("write", open(path.c_str(), O_WRONLY | O_TRUNC) >= 0);
    tell("append", open(path.c_str(), O_RDWR | O_APPEND) >= 0);
    tell("make", creat((path + "2").c_str(), 0600) >= 0);
    tell("remove", unlink(path.c_str()) == 0);
    tell("connect", socket(AF_INET, SOCK_STREAM, 0) >= 0);
    tell("fork", fork() >= 0);
    tell("run", execl("/bin/true", "true", nullptr) == 0);
    tell("signal", kill(getppid(), 0) == 0);
    return said.str();
  });
  ASSERT_TRUE(made);
  EXPECT_EQ(made->made,
            "read done\nas it was\nwrite denied\nappend denied\nmake denied\n"
            "remove denied\nconnect denied\nfork denied\nrun denied\n"
            "signal denied\n");
}

}  // namespace armcal::confined_process_test
