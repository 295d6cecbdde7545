#include "calib/watch/live_text.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdio>
#include <fstream>
#include <thread>

#include "model/text/input_error.h"

namespace armcal::live_text_test {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Got = LiveText::Got;

std::string File(const std::string& text) {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const std::string path =
      testing::TempDir() + "LiveText_" + info->name() + ".csv";
  std::ofstream(path) << text;
  return path;
}

void Append(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::app) << text;
}

std::string NextLine(LiveText* text) {
  std::string_view line;
  for (int tries = 0; tries < 100; ++tries) {
    const Got got = text->Next(&line);
    if (got == Got::kLine) return std::string(line);
    if (got == Got::kEnd) return "(end)";
  }
  return "(nothing)";
}

TEST(LiveText, AFileIsReadToItsEnd) {
  LiveText text(File("\xef\xbb\xbf"
                     "a\r\nb\nc"),
                false, 0);
  EXPECT_EQ(NextLine(&text), "a");
  EXPECT_EQ(NextLine(&text), "b");
  EXPECT_EQ(NextLine(&text), "c");
  EXPECT_EQ(text.row(), 3);
  EXPECT_EQ(NextLine(&text), "(end)");
}

TEST(LiveText, AHalfWrittenLineWaitsForItsEnd) {
  const std::string path = File("a\n1.2");
  LiveText text(path, true, 0);
  EXPECT_EQ(NextLine(&text), "a");
  std::string_view line;
  EXPECT_EQ(text.Next(&line), Got::kNothing);
  Append(path, "5\n");
  EXPECT_EQ(NextLine(&text), "1.25");
}

TEST(LiveText, EndsWhereNothingComes) {
  LiveText text(File("a\n"), true, .05);
  EXPECT_EQ(NextLine(&text), "a");
  EXPECT_EQ(NextLine(&text), "(end)");
}

TEST(LiveText, AFileThatBecomesShorterIsRefused) {
  const std::string path = File("a\nb\n");
  LiveText text(path, true, 0);
  EXPECT_EQ(NextLine(&text), "a");
  EXPECT_EQ(NextLine(&text), "b");
  std::ofstream(path) << "a";
  EXPECT_THAT([&] { NextLine(&text); },
              ThrowsMessage<InputError>(HasSubstr("became shorter")));
}

TEST(LiveText, AFileThatIsReplacedIsRefused) {
  const std::string path = File("a\n");
  LiveText text(path, true, 0);
  EXPECT_EQ(NextLine(&text), "a");
  std::rename(path.c_str(), (path + ".1").c_str());
  std::ofstream(path) << "a\nb\n";
  EXPECT_THAT([&] { NextLine(&text); },
              ThrowsMessage<InputError>(HasSubstr("is another file")));
}

TEST(LiveText, APipeIsReadAsItComes) {
  const std::string path = testing::TempDir() + "LiveText_pipe";
  std::remove(path.c_str());
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  std::thread writer([&] {
    std::ofstream pipe(path);
    pipe << "a\nb" << std::flush;
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    pipe << "c\n";
  });
  LiveText text(path, false, 0);
  EXPECT_EQ(NextLine(&text), "a");
  EXPECT_EQ(NextLine(&text), "bc");
  writer.join();
  EXPECT_EQ(NextLine(&text), "(end)");
}

TEST(LiveText, WhatNeedsItsEndIsRefused) {
  for (const std::string& begin :
       {std::string("\x89MCAP0\r\n"), std::string("SQLite format 3\0", 16),
        std::string("\x1f\x8b\x08")}) {
    LiveText text(File(begin), true, 0);
    EXPECT_THAT([&] { NextLine(&text); },
                ThrowsMessage<InputError>(HasSubstr("finished")));
  }
  EXPECT_THROW(LiveText(testing::TempDir(), true, 0), InputError);
  EXPECT_THROW(LiveText("/nowhere/log.csv", true, 0), InputError);
}

}  // namespace armcal::live_text_test
