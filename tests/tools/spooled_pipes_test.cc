#include "tools/spooled_pipes.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "model/text/input_error.h"

namespace armcal::spooled_pipes_test {

namespace fs = std::filesystem;

std::string Read(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class SpooledPipesTest : public testing::Test {
 protected:
  SpooledPipesTest() {
    // Of a pipe that is refused, its writer is told by an error.
    std::signal(SIGPIPE, SIG_IGN);
    fs::remove(pipe_);
    mkfifo(pipe_.c_str(), 0600);
  }
  ~SpooledPipesTest() override { fs::remove(pipe_); }

  // What `read` says of the pipe while somebody writes this into it.
  template <typename F>
  auto While(const std::string& text, const F& read) {
    std::thread writer([&] { std::ofstream(pipe_) << text; });
    const auto said = read();
    writer.join();
    return said;
  }

  const std::string pipe_ = testing::TempDir() + "spooled_pipes_test.fifo";
  SpooledPipes pipes_;
};

TEST_F(SpooledPipesTest, GiveTheirBytesAsOftenAsOneAsks) {
  std::string text;  // longer than what a pipe holds
  for (int k = 0; k < 100000; ++k) text += std::to_string(k) + "\n";
  const std::string path = While(text, [&] { return pipes_.PathOf(pipe_); });
  EXPECT_NE(path, pipe_);
  // Not EXPECT_EQ, which would look for the lines that differ for minutes.
  EXPECT_TRUE(Read(path) == text);
  EXPECT_TRUE(Read(path) == text);
  EXPECT_EQ(pipes_.PathOf(pipe_), path) << "nobody writes into it any more";
}

TEST_F(SpooledPipesTest, LeaveFilesAlone) {
  EXPECT_EQ(pipes_.PathOf(testing::TempDir()), testing::TempDir());
  EXPECT_EQ(pipes_.PathOf("/dev/zero"), "/dev/zero");
  EXPECT_EQ(pipes_.PathOf("missing.csv"), "missing.csv");
}

TEST_F(SpooledPipesTest, SayWhereTheyCannotBeKept) {
  setenv("TMPDIR", "/nowhere", 1);
  const std::string said = While("1", [&]() -> std::string {
    try {
      return pipes_.PathOf(pipe_);
    } catch (const InputError& error) {
      return error.what();
    }
  });
  unsetenv("TMPDIR");
  EXPECT_EQ(said, pipe_ +
                      ": is a pipe, which cannot be kept in /nowhere ($TMPDIR "
                      "says where): No such file or directory");
}

}  // namespace armcal::spooled_pipes_test
