#include "tests/blind/blind_runner.h"

#include <glog/logging.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "calib/numerics/json_value.h"
#include "model/text/input_error.h"
#include "tests/blind/isolated_process.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A folder of its own, gone afterwards.
class Scratch {
 public:
  Scratch() {
    std::string name = fs::temp_directory_path() / "armcal_blind_XXXXXX";
    PCHECK(mkdtemp(name.data())) << name;
    path_ = name;
    GiveAway(path_);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Readable for everybody, whatever the original was.
void CopyReadable(const fs::path& from, const fs::path& to, bool program) {
  fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  fs::permissions(to, static_cast<fs::perms>(program ? 0755 : 0644));
}

// Whether a process like the diagnoser's can read one of the labels, or list
// them.
bool CanReadLabels(const std::string& labels, const fs::path& scratch) {
  const auto readable = [&scratch](const std::string& test,
                                   const std::string& path) {
    return RunIsolated({"/usr/bin/test", test, path}, scratch, "probe", 10)
               .exit_code != 1;
  };
  if (readable("-r", labels) || readable("-x", labels)) return true;
  for (const auto& entry : fs::recursive_directory_iterator(labels)) {
    if (readable("-r", fs::absolute(entry.path()))) return true;
  }
  return false;
}

void CloseLabels(const std::string& labels, const fs::path& scratch) {
  if (labels.empty() || !fs::exists(labels)) return;
  if (!CanIsolate()) {
    throw InputError(labels, "", "",
                     "expected no labels on this machine: only root can hide "
                     "them from the diagnoser");
  }
  const std::string path = fs::canonical(labels);
  fs::permissions(path, fs::perms::owner_all);
  if (CanReadLabels(path, scratch)) {
    throw InputError(labels, "", "",
                     "the diagnoser's process could read the labels");
  }
}

// The robot's file in a case's folder.
std::string RobotFile(const JsonValue& content) {
  return content.Has("robot") ? content.At("robot").Text() : "robot.yaml";
}

// As case.json has it: what a key of the bench's own cases says can be left out
// by others.
std::vector<std::string> Command(const fs::path& program,
                                 const JsonValue& content,
                                 const std::vector<std::string>& flags) {
  std::vector<std::string> command = {program, "diagnose",
                                      "--robot=" + RobotFile(content)};
  if (content.Has("trust")) {
    char trust[40];
    std::snprintf(trust, sizeof trust, "--trust=%.17g",
                  content.At("trust").Number());
    command.push_back(trust);
  }
  command.push_back("--log=training.csv");
  if (!content.Has("validation") || content.At("validation").Bool()) {
    command.push_back("--validate=validation.csv");
  }
  if (content.At("reference").Bool()) {
    command.push_back("--reference=reference.csv");
  }
  if (content.Has("flags")) {
    for (const JsonValue& flag : content.At("flags").Entries()) {
      command.push_back(flag.Text());
    }
  }
  command.insert(command.end(), flags.begin(), flags.end());
  command.push_back("--out=out");
  return command;
}

void WriteText(const fs::path& path, const std::string& text) {
  const fs::path part = path.string() + ".part";  // a run may be interrupted
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  CHECK(file) << "cannot write " << part;
  fs::rename(part, path);
}

fs::path OtherValidation(const BlindRunOptions& options,
                         const fs::path& folder) {
  return fs::path(options.validation) / folder.filename() / "validation.csv";
}

// Whether there is an answer afterwards. run.json comes last: with it the case
// has been run.
bool RunCase(const BlindRunOptions& options, const fs::path& program,
             const fs::path& folder) {
  const Scratch scratch;
  const std::string file = folder / "case.json";
  const json parsed = ReadJson(file);
  const JsonValue content(file, "", parsed);
  for (const std::string& name :
       {RobotFile(content), std::string("training.csv"),
        std::string("validation.csv"), std::string("reference.csv"),
        std::string("controller.yaml")}) {
    if (fs::exists(folder / name)) {
      CopyReadable(folder / name, scratch.path() / name, false);
    }
  }
  if (!options.validation.empty()) {
    CopyReadable(OtherValidation(options, folder),
                 scratch.path() / "validation.csv", false);
  }
  const ProcessEnd end =
      RunIsolated(Command(program, content, options.flags), scratch.path(),
                  "output.txt", options.timeout_s);
  const fs::path answer = fs::path(options.answers) / folder.filename();
  fs::create_directories(answer);
  const fs::path diagnosis = scratch.path() / "out" / "diagnosis.json";
  // Whatever the diagnoser left: a plain file, not a link to somewhere.
  const bool answered =
      !end.timed_out && fs::is_regular_file(fs::symlink_status(diagnosis));
  if (answered) {
    CopyReadable(diagnosis, answer / "diagnosis.json", false);
  }
  if (fs::is_regular_file(fs::symlink_status(scratch.path() / "output.txt"))) {
    CopyReadable(scratch.path() / "output.txt", answer / "output.txt", false);
  }
  WriteText(answer / "run.json", json({{"exit_code", end.exit_code},
                                       {"timed_out", end.timed_out},
                                       {"seconds", end.seconds},
                                       {"cpu_seconds", end.cpu_seconds}})
                                         .dump(2) +
                                     "\n");
  return answered;
}

std::vector<fs::path> CaseFolders(const BlindRunOptions& options) {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(options.logs)) {
    if (!fs::exists(entry.path() / "case.json")) continue;
    if (!options.validation.empty() &&
        !fs::exists(OtherValidation(options, entry.path()))) {
      continue;
    }
    folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

}  // namespace

BlindRunSummary RunBlindCases(const BlindRunOptions& options) {
  const Scratch scratch;
  CloseLabels(options.labels, scratch.path());
  // A copy: nobody may be unable to reach the original, which may be rebuilt
  // while cases run.
  const fs::path program = scratch.path() / "armcal";
  CopyReadable(options.diagnoser, program, true);
  fs::permissions(scratch.path(), static_cast<fs::perms>(0755));
  const std::vector<fs::path> folders = CaseFolders(options);
  std::atomic<size_t> next = 0;
  std::atomic<int> kept = 0, answered = 0, failed = 0;
  const auto work = [&] {
    for (size_t k = next++; k < folders.size(); k = next++) {
      if (fs::exists(fs::path(options.answers) / folders[k].filename() /
                     "run.json")) {
        ++kept;
      } else {
        ++(RunCase(options, program, folders[k]) ? answered : failed);
      }
    }
  };
  std::vector<std::thread> threads;
  for (int job = 0; job < options.jobs; ++job) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return {kept, answered, failed};
}

}  // namespace armcal
