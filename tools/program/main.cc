// armcal COMMAND --flags

#include <gflags/gflags.h>
#include <glog/logging.h>
#include <sys/resource.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "calib/numerics/thread_limit.h"
#include "model/text/input_error.h"
#include "model/text/option_name.h"
#include "tools/completion.h"
#include "tools/console.h"
#include "tools/flag_parser.h"
#include "tools/heap.h"
#include "tools/input_flags.h"
#include "tools/interruption.h"
#include "tools/manual.h"
#include "tools/nearest_name.h"
#include "tools/program/command_list.h"
#include "tools/progress_bar.h"
#include "tools/usage.h"
#include "tools/version.h"

namespace armcal {
namespace {

using Words = std::vector<std::string>;

bool IsOneOf(const std::string& word, const Words& words) {
  for (const std::string& one : words) {
    if (one == word) return true;
  }
  return false;
}

const Words kHelp = {"-h", "-help", "--help", "help"};
const Words kVersion = {"--version", "-version", "version"};
const Words kFullHelp = {"--helpfull", "-helpfull", "--all"};

const Command& CommandNamed(const std::string& name) {
  if (const Command* command = FindCommand(name)) return *command;
  Words names = {"completion", "help", "version"};
  for (const Command& command : Commands()) names.push_back(command.name);
  throw UsageError("unknown command '" + name + "'" + DidYouMean(name, names) +
                   "; see armcal --help");
}

// "help", "help COMMAND", "help COMMAND --all"; "help --man" is for packages.
int Help(const Words& words) {
  if (words.empty()) {
    PrintText(GeneralHelp(Commands()));
  } else if (words[0] == "--man") {
    PrintText(ManualPage(Commands()));
  } else {
    const bool all = words.size() > 1 && IsOneOf(words[1], kFullHelp);
    PrintText(CommandHelp(CommandNamed(words[0]), all));
  }
  return kExitOk;
}

int RunAndTell(const Command& command, const FlagValues& flags) {
  const ThreadLimit limit(ThreadsFromFlags(flags));
  ProgressBar bar("reading the input");
  CommandInput input;
  input.flags = flags;
  input.progress = bar.Callback();
  CommandOutcome outcome = command.run(input);
  OutputFolder::WriteTogether(&outcome.folders);
  Print(outcome.output, flags);
  return outcome.code();
}

int Run(const Command& command, int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    const bool all = IsOneOf(argv[k], kFullHelp);
    if (!all && !IsOneOf(argv[k], kHelp)) continue;
    PrintText(CommandHelp(command, all));
    return kExitOk;
  }
  const ParsedFlags parsed = ParseFlags(command, argc, argv);
  try {
    return RunAndTell(command, parsed.values);
  } catch (const OptionError& error) {
    // "--bandwidth: found .." of a flag file's line.
    const std::string text = error.what();
    const std::string name = text.substr(0, text.find_first_of(": ="));
    const auto place =
        parsed.places.find(name.substr(std::min<size_t>(2, name.size())));
    if (place == parsed.places.end()) throw;
    throw UsageError(place->second + text);
  }
}

int Main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << GeneralHelp(Commands());
    return kExitUsage;
  }
  const Words words(argv + 1, argv + argc);
  const Words rest(words.begin() + 1, words.end());
  if (IsOneOf(words[0], kHelp)) return Help(rest);
  if (IsOneOf(words[0], kVersion)) {
    PrintText(VersionText());
    return kExitOk;
  }
  if (words[0] == "completion") {
    PrintText(Completion(Commands(), rest));
    return kExitOk;
  }
  // All flags of all commands would be too many at once.
  if (IsOneOf(words[0], kFullHelp)) {
    PrintText(GeneralHelp(Commands()));
    return kExitOk;
  }
  CheckLibraryVersions();
  return Run(CommandNamed(words[0]), argc - 1, argv + 1);
}

// After glog has said which CHECK failed. [[noreturn]] would not be part of the
// function's type, which clang and glog expect of it.
__attribute__((noreturn)) void FailInternally() {
  std::cerr << "This is a bug in armcal; please report it.\n";
  std::_Exit(kExitInternal);
}

// Memory, or a thread, which needs some.
bool IsOutOfMemory(const std::exception& error) {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         (system != nullptr &&
          system->code() == std::errc::resource_unavailable_try_again) ||
         std::strstr(error.what(), "pthread_create") != nullptr;  // oneTBB's
}

std::string MemoryLimitText() {
  rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return "memory: there is no more of it";
  }
  return "memory: the " + std::to_string(limit.rlim_cur >> 20) +
         " MB that are allowed (ulimit -v) do not suffice";
}

// Says what the exception that is being handled means; the exit code.
int TellError() {
  try {
    throw;
  } catch (const OptionError& error) {
    PrintError(error.what());
    return kExitUsage;
  } catch (const InputError& error) {
    PrintError(error.what());
    return kExitBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    PrintError(error.path1().string() + ": " + error.code().message());
    return kExitBadInput;
  } catch (const std::exception& error) {
    if (IsOutOfMemory(error)) {
      PrintError(MemoryLimitText() +
                 "; fewer --threads or a shorter --crop need less");
      return kExitBadInput;
    }
    PrintError(std::string("internal error: ") + error.what() +
               "\nThis is a bug in armcal; please report it.");
  } catch (...) {
    FailInternally();
  }
  return kExitInternal;
}

// An exception that nothing catches, of a thread for example.
[[noreturn]] void Terminate() {
  if (std::current_exception() == nullptr) FailInternally();
  std::_Exit(TellError());
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  armcal::PrepareProcess();
  armcal::SetOptionPrefix("--");
  armcal::PrepareHeap();
  FLAGS_logtostderr = true;
  google::InitGoogleLogging(argv[0]);
  google::InstallFailureFunction(&armcal::FailInternally);
  std::set_terminate(&armcal::Terminate);
  try {
    return armcal::Main(argc, argv);
  } catch (const std::exception&) {
    return armcal::TellError();
  }
}
