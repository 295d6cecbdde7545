// armcal COMMAND --flags

#include <gflags/gflags.h>
#include <glog/logging.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "model/input_error.h"
#include "tools/command.h"
#include "tools/usage.h"

namespace armcal {
namespace {

bool IsHelp(const char* argument) {
  for (const char* help : {"-h", "-help", "--help", "help"}) {
    if (std::strcmp(argument, help) == 0) return true;
  }
  return false;
}

int Run(const Command& command, int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    if (IsHelp(argv[k])) {
      std::cout << CommandHelp(command);
      return kExitOk;
    }
  }
  ParseFlags(command, argc, argv);
  return command.run();
}

[[noreturn]] void RefuseCommand(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : Commands()) names.push_back(command.name);
  const std::string nearest = NearestName(name, names);
  throw UsageError("unknown command '" + name + "'" +
                   (nearest.empty() ? "" : "; did you mean " + nearest + "?") +
                   "; see armcal --help");
}

int Main(int argc, char** argv) {
  if (argc < 2 || IsHelp(argv[1])) {
    (argc < 2 ? std::cerr : std::cout) << GeneralHelp();
    return argc < 2 ? kExitUsage : kExitOk;
  }
  if (std::strcmp(argv[1], "--version") == 0) {
    std::cout << "armcal " ARMCAL_VERSION "\n";
    return kExitOk;
  }
  for (const Command& command : Commands()) {
    if (std::strcmp(argv[1], command.name) != 0) continue;
    return Run(command, argc - 1, argv + 1);
  }
  RefuseCommand(argv[1]);
}

// After glog has said which CHECK failed.
[[noreturn]] void FailInternally() {
  std::cerr << "This is a bug in armcal; please report it.\n";
  std::_Exit(kExitInternal);
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  FLAGS_logtostderr = true;
  google::InitGoogleLogging(argv[0]);
  google::InstallFailureFunction(&armcal::FailInternally);
  try {
    return armcal::Main(argc, argv);
  } catch (const armcal::UsageError& error) {
    std::cerr << "armcal: " << error.what() << "\n";
    return armcal::kExitUsage;
  } catch (const armcal::InputError& error) {
    std::cerr << "armcal: " << error.what() << "\n";
    return armcal::kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << "armcal: internal error: " << error.what()
              << "\nThis is a bug in armcal; please report it.\n";
    return armcal::kExitInternal;
  }
}
