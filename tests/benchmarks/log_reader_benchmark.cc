// How fast logs are read: 1e5 rows of t, q, qd, qdd and tau of six joints, of
// which t, q and tau are used. The yardstick is std::from_chars of all numbers
// of the same file, block by block, and nothing else.
#include <benchmark/benchmark.h>
#include <unistd.h>
#include <zlib.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "model/log_files/kept_log.h"

namespace armcal {
namespace {

constexpr int kJoints = 6;
constexpr int kRows = 100000;
constexpr int kNumbers = kRows * (1 + 4 * kJoints);

// The log as a file, which goes when the program ends.
class LogFile {
 public:
  LogFile(const char* name, bool gzip)
      : path_(std::filesystem::temp_directory_path() /
              (std::to_string(getpid()) + name)) {
    const std::string text = Text();
    if (gzip) {
      gzFile file = gzopen(path_.c_str(), "wb6");
      gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
      gzclose(file);
    } else {
      std::FILE* file = std::fopen(path_.c_str(), "wb");
      std::fwrite(text.data(), 1, text.size(), file);
      std::fclose(file);
    }
  }
  ~LogFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_; }

 private:
  static std::string Text() {
    std::string text = "t";
    for (const char* signal : {"q", "qd", "qdd", "tau"}) {
      for (int j = 1; j <= kJoints; ++j) {
        text += "," + std::string(signal) + std::to_string(j);
      }
    }
    char number[40];
    for (int k = 0; k < kRows; ++k) {
      std::snprintf(number, sizeof(number), "\n%.6f", 1e-3 * k);
      text += number;
      for (int c = 0; c < 4 * kJoints; ++c) {
        std::snprintf(number, sizeof(number), ",%.9g",
                      std::sin(1e-3 * (1 + c) * k) * (1 + 5 * c));
        text += number;
      }
    }
    return text + "\n";
  }
  std::filesystem::path path_;
};

const std::string& Csv() {
  static const LogFile file("_log.csv", false);
  static const std::string path = file.path();
  return path;
}

const std::string& Gzipped() {
  static const LogFile file("_log.csv.gz", true);
  static const std::string path = file.path();
  return path;
}

LogReaderOptions SixJoints() {
  LogReaderOptions options;
  for (int j = 1; j <= kJoints; ++j) {
    options.joint_names.push_back("joint" + std::to_string(j));
  }
  return options;
}

// Returns the sum of all numbers below the header.
double ParseAlone(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  std::vector<char> block(1 << 20);
  size_t kept = 0;
  double sum = 0;
  bool header = true;
  while (true) {
    const size_t read =
        std::fread(block.data() + kept, 1, block.size() - kept, file);
    if (read == 0) break;
    const char* p = block.data();
    const char* const end = p + kept + read;
    const char* whole = end;  // lines
    while (whole[-1] != '\n') --whole;
    if (header) p = static_cast<const char*>(std::memchr(p, '\n', end - p)) + 1;
    header = false;
    while (p < whole) {
      double value;
      p = std::from_chars(p, whole, value).ptr + 1;
      sum += value;
    }
    kept = static_cast<size_t>(end - whole);
    std::memmove(block.data(), whole, kept);
  }
  std::fclose(file);
  return sum;
}

void ParsingAlone(benchmark::State& state) {
  const std::string& path = Csv();
  for (auto _ : state) benchmark::DoNotOptimize(ParseAlone(path));
  state.SetItemsProcessed(state.iterations() * kNumbers);
}
BENCHMARK(ParsingAlone)
    ->Name("Log/parsing_alone")
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void ReadAll(const std::string& path, benchmark::State* state) {
  const LogReaderOptions options = SixJoints();
  for (auto _ : *state) {
    LogReader reader(path, options);
    Log log;
    while (reader.Read(4096, &log)) benchmark::DoNotOptimize(log.tau.data());
  }
  state->SetItemsProcessed(state->iterations() * kNumbers);
}

void ReadingALog(benchmark::State& state) { ReadAll(Csv(), &state); }
BENCHMARK(ReadingALog)
    ->Name("Log/read")
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void ReadingAGzippedLog(benchmark::State& state) { ReadAll(Gzipped(), &state); }
BENCHMARK(ReadingAGzippedLog)
    ->Name("Log/read_gzipped")
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void PassOverAKeptLog(benchmark::State& state) {
  KeptLog log(Csv(), SixJoints(),
              std::make_shared<MemoryBudget>(MemoryBudget::DefaultBytes()));
  while (log.Next() != nullptr) {
  }
  for (auto _ : state) {
    log.Rewind();
    while (const Log* block = log.Next()) {
      benchmark::DoNotOptimize(block->tau.data());
    }
  }
}
BENCHMARK(PassOverAKeptLog)
    ->Name("Log/pass_over_kept")
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
}  // namespace armcal
