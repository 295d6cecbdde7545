#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/fuzz/fuzzed_readers.h"

namespace armcal::damaged_files_test {

namespace fs = std::filesystem;

std::string BytesOf(const fs::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

class FuzzedReadersTest : public testing::TestWithParam<FuzzedReader> {};

// Of what tools/fuzz.sh has found: files that between them reach code which no
// other one of them does, and all that ever broke a reader.
TEST_P(FuzzedReadersTest, StandTheKeptInputs) {
  const FuzzedReader& reader = GetParam();
  const std::string folder = testing::TempDir() + "fuzzed_" + reader.name;
  fs::create_directories(folder);
  int read = 0, refused = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(DAMAGED_FILES) / reader.name)) {
    SCOPED_TRACE(entry.path());
    const std::string bytes = BytesOf(entry.path());
    ++(ReadsAs(reader, folder, bytes.data(), bytes.size()) ? read : refused);
  }
  fs::remove_all(folder);
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

INSTANTIATE_TEST_SUITE_P(All, FuzzedReadersTest,
                         testing::ValuesIn(FuzzedReaders()),
                         [](const auto& info) { return info.param.name; });

}  // namespace armcal::damaged_files_test
