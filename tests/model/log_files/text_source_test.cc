#include "model/log_files/text_source.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <random>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::text_source_test {

// All lines, each with its number, as "1:t,q1|2:0,1|".
std::string Lines(TextSource* source) {
  std::string all;
  std::string_view line;
  while (source->NextLine(&line)) {
    all += std::to_string(source->row()) + ":" + std::string(line) + "|";
  }
  return all;
}

std::string Read(const std::string& path,
                 int block_bytes = TextSource::kBlockBytes) {
  TextSource source(path, block_bytes);
  return Lines(&source);
}

std::string Refusal(const std::string& path,
                    int block_bytes = TextSource::kBlockBytes) {
  return MessageOf<InputError>(path, [&] { Read(path, block_bytes); });
}

// Incompressible enough that its gzip stream has several blocks.
std::string LongText() {
  std::mt19937 generator(1);
  std::uniform_int_distribution<int> digit('0', '9'), length(0, 60);
  std::string text;
  for (int i = 0; i < 20000; ++i) {
    for (int n = length(generator); n > 0; --n) text += char(digit(generator));
    text += i % 3 ? "\n" : "\r\n";
  }
  return text;
}

TEST(TextSource, CutsLines) {
  EXPECT_EQ(Read(WriteFile("a\nb\n")), "1:a|2:b|");
  EXPECT_EQ(Read(WriteFile("a\nb")), "1:a|2:b|");
  EXPECT_EQ(Read(WriteFile("a\r\nb\r\n")), "1:a|2:b|");
  EXPECT_EQ(Read(WriteFile("\n\na\n\n")), "1:|2:|3:a|4:|");
  EXPECT_EQ(Read(WriteFile("\xef\xbb\xbf"
                           "a\n\xef\xbb\xbf"
                           "b\n")),
            "1:a|2:\xef\xbb\xbf"
            "b|");
  EXPECT_EQ(Read(WriteFile("")), "");
  EXPECT_EQ(Read(WriteFile("x")), "1:x|");
}

TEST(TextSource, SaysWhetherTheLastLineIsCut) {
  TextSource source(WriteFile("a\nb"));
  std::string_view line;
  ASSERT_TRUE(source.NextLine(&line));
  EXPECT_FALSE(source.cut());
  ASSERT_TRUE(source.NextLine(&line));
  EXPECT_TRUE(source.cut());
}

TEST(TextSource, BlockSizeAndCompressionChangeNothing) {
  const std::string text = LongText();
  const std::string plain = WriteFile(text, "plain.gz");  // the name lies
  const std::string half = text.substr(0, text.size() / 2);
  const std::string rest = text.substr(half.size());
  const std::string gz = WriteFile(Gzip(text), "gz.csv");
  const std::string two = WriteFile(Gzip(half) + Gzip(rest), "two.gz");
  const std::string lines = Read(plain);
  EXPECT_GT(lines.size(), 500000u);
  for (const std::string& path : {plain, gz, two}) {
    for (int block : {64, 100, 4096, 1 << 20}) {
      EXPECT_TRUE(Read(path, block) == lines) << path << " " << block;
    }
  }
}

TEST(TextSource, RewindReadsTheSame) {
  for (const std::string& bytes : {LongText(), Gzip(LongText())}) {
    TextSource source(WriteFile(bytes), 4096);
    const std::string all = Lines(&source);
    source.Rewind();
    EXPECT_EQ(source.row(), 0);
    EXPECT_TRUE(Lines(&source) == all);
    source.Rewind();
    std::string_view line;
    source.NextLine(&line);  // and from the middle
    source.Rewind();
    EXPECT_TRUE(Lines(&source) == all);
  }
}

TEST(TextSource, RefusesTruncatedGzipWhereverItEnds) {
  const std::string gz = Gzip(LongText());
  for (size_t size :
       {size_t{2}, size_t{5}, size_t{10}, size_t{11}, gz.size() / 2,
        gz.size() - 9, gz.size() - 8, gz.size() - 4, gz.size() - 1}) {
    const std::string path = WriteFile(gz.substr(0, size));
    const std::string message = Refusal(path);
    EXPECT_NE(message.find("the gzip stream ends early"), message.npos)
        << size << " of " << gz.size() << ": " << message;
    EXPECT_EQ(Refusal(path, 64), message) << size;
  }
}

TEST(TextSource, DeliversAllThatATruncatedGzipHolds) {
  // Few bytes hold many lines: the input ends long before the output.
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "0,0\n";
  const std::string gz = Gzip(text);
  for (size_t size = gz.size() - 40; size < gz.size() - 8; ++size) {
    const std::string path = WriteFile(gz.substr(0, size));
    EXPECT_EQ(Refusal(path, 64), Refusal(path)) << size;
  }
}

TEST(TextSource, RefusesDamagedGzip) {
  std::string crc = Gzip("a\nb\nc\n");
  crc[crc.size() - 8] ^= 1;
  EXPECT_EQ(Refusal(WriteFile(crc)),
            "FILE: row 4: the gzip stream is damaged; copy or record the file "
            "again");
  std::string middle = Gzip(LongText());
  for (size_t i = 0; i < 40; ++i) middle[middle.size() / 2 + i] ^= 0x55;
  const std::string message = Refusal(WriteFile(middle));
  EXPECT_NE(message.find("the gzip stream is damaged"), message.npos);
}

TEST(TextSource, RefusesBytesAfterGzip) {
  for (const char* after : {"\n", "garbage", "\x1f", "0,1,2\n0,1,2\n"}) {
    EXPECT_EQ(Refusal(WriteFile(Gzip("a\nb\n") + after)),
              "FILE: row 3: bytes that are not gzip follow the gzip stream; "
              "cut them off or unpack the file")
        << after;
  }
}

TEST(TextSource, RefusesWhatIsNoText) {
  using std::string_literals::operator""s;
  EXPECT_EQ(Refusal("/nonexistent/log.csv"),
            "FILE: cannot be opened: No such file or directory");
  EXPECT_EQ(Refusal(testing::TempDir()),
            "FILE: cannot be read: Is a directory");
  EXPECT_EQ(Refusal(WriteFile("\xff\xfe"
                              "a\0b\0"s)),
            "FILE: the text is UTF-16; save it as UTF-8");
  const std::string nul =
      ": a NUL byte: the file is binary or UTF-16, or was being written when "
      "the power went";
  EXPECT_EQ(Refusal(WriteFile("a\nb\nc\0\0"s)), "FILE: row 3" + nul);
  EXPECT_EQ(Refusal(WriteFile(Gzip("a\nb\n\0"s))), "FILE: row 3" + nul);
}

TEST(TextSource, RefusesAFileThatChanges) {
  const std::string text(1 << 20, '\n');
  for (const long bytes : {1L << 19, (1L << 20) + 1}) {
    const std::string path = WriteFile(text);
    EXPECT_EQ(MessageOf<InputError>(path,
                                    [&] {
                                      TextSource source(path, 1000);
                                      std::string_view line;
                                      source.NextLine(&line);
                                      std::filesystem::resize_file(path, bytes);
                                      while (source.NextLine(&line)) {
                                      }
                                    }),
              "FILE: has changed while it was read: 1048576 bytes at first, " +
                  std::to_string(bytes) +
                  " now; read it when its recording has ended");
  }
}

TEST(TextSource, RefusesALineLongerThanABlock) {
  EXPECT_EQ(Refusal(WriteFile("a\n" + std::string(63, 'x') + "\n"), 64), "");
  EXPECT_EQ(Refusal(WriteFile("a\n" + std::string(64, 'x') + "\n"), 64),
            "FILE: row 2: the line is longer than 64 bytes; this is not a log "
            "in CSV");
  const std::string long_line((1 << 20) + 1, 'x');
  EXPECT_NE(Refusal(WriteFile(long_line)), "");
  EXPECT_NE(Refusal(WriteFile(Gzip(long_line))), "");
}

}  // namespace armcal::text_source_test
