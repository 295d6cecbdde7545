// armcal COMMAND --flags

#include <gflags/gflags.h>
#include <glog/logging.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "calib/thread_limit.h"
#include "model/input_error.h"
#include "tools/command.h"
#include "tools/completion.h"
#include "tools/console.h"
#include "tools/flag_parser.h"
#include "tools/heap.h"
#include "tools/input_flags.h"
#include "tools/interruption.h"
#include "tools/manual.h"
#include "tools/nearest_name.h"
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
const Words kFullHelp = {"--helpfull", "-helpfull", "--all"};

const Command& CommandNamed(const std::string& name) {
  if (const Command* command = FindCommand(name)) return *command;
  Words names = {"completion", "help"};
  for (const Command& command : Commands()) names.push_back(command.name);
  throw UsageError("unknown command '" + name + "'" + DidYouMean(name, names) +
                   "; see armcal --help");
}

// "help", "help COMMAND", "help COMMAND --all"; "help --man" is for packages.
int Help(const Words& words) {
  if (words.empty()) {
    PrintText(GeneralHelp());
  } else if (words[0] == "--man") {
    PrintText(ManualPage());
  } else {
    const bool all = words.size() > 1 && IsOneOf(words[1], kFullHelp);
    PrintText(CommandHelp(CommandNamed(words[0]), all));
  }
  return kExitOk;
}

int RunAndTell(const Command& command) {
  const ThreadLimit limit(ThreadsFromFlags());
  ProgressBar bar("reading the input");
  CommandOutcome outcome = command.run({std::nullopt, bar.Callback()});
  OutputFolder::WriteTogether(&outcome.folders);
  Print(outcome.output);
  return outcome.code();
}

int Run(const Command& command, int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    const bool all = IsOneOf(argv[k], kFullHelp);
    if (!all && !IsOneOf(argv[k], kHelp)) continue;
    PrintText(CommandHelp(command, all));
    return kExitOk;
  }
  const auto places = ParseFlags(command, argc, argv);
  try {
    return RunAndTell(command);
  } catch (const UsageError& error) {
    // "--bandwidth: found .." of a flag file's line.
    const std::string text = error.what();
    const std::string name = text.substr(0, text.find_first_of(": ="));
    const auto place =
        places.find(name.substr(std::min<size_t>(2, name.size())));
    if (place == places.end()) throw;
    throw UsageError(place->second + text);
  }
}

int Main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << GeneralHelp();
    return kExitUsage;
  }
  const Words words(argv + 1, argv + argc);
  const Words rest(words.begin() + 1, words.end());
  if (IsOneOf(words[0], kHelp)) return Help(rest);
  if (words[0] == "--version") {
    PrintText(VersionText());
    return kExitOk;
  }
  if (words[0] == "completion") {
    PrintText(Completion(rest));
    return kExitOk;
  }
  return Run(CommandNamed(words[0]), argc - 1, argv + 1);
}

// After glog has said which CHECK failed.
[[noreturn]] void FailInternally() {
  std::cerr << "This is a bug in armcal; please report it.\n";
  std::_Exit(kExitInternal);
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  armcal::PrepareProcess();
  armcal::PrepareHeap();
  FLAGS_logtostderr = true;
  google::InitGoogleLogging(argv[0]);
  google::InstallFailureFunction(&armcal::FailInternally);
  try {
    return armcal::Main(argc, argv);
  } catch (const armcal::UsageError& error) {
    armcal::PrintError(error.what());
    return armcal::kExitUsage;
  } catch (const armcal::InputError& error) {
    armcal::PrintError(error.what());
    return armcal::kExitBadInput;
  } catch (const std::filesystem::filesystem_error& error) {
    armcal::PrintError(error.path1().string() + ": " + error.code().message());
    return armcal::kExitBadInput;
  } catch (const std::exception& error) {
    armcal::PrintError(std::string("internal error: ") + error.what() +
                       "\nThis is a bug in armcal; please report it.");
    return armcal::kExitInternal;
  }
}
