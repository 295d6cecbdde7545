#include "tools/python/flag_session.h"

#include <chrono>
#include <vector>

#include "model/text/input_text.h"
#include "tools/flag_parser.h"
#include "tools/program/command_list.h"
#include "tools/python/samples.h"

namespace armcal {
namespace {

std::timed_mutex all_flags;
thread_local bool in_session = false;

std::unique_lock<std::timed_mutex> Wait() {
  if (in_session) {
    throw UsageError("a command is running in this thread already");
  }
  std::unique_lock<std::timed_mutex> lock(all_flags, std::defer_lock);
  while (!lock.try_lock_for(std::chrono::milliseconds(100))) CheckSignals();
  return lock;
}

}  // namespace

const Command& CommandNamed(const std::string& name) {
  if (const Command* command = FindCommand(name)) return *command;
  std::vector<std::string> names;
  for (const Command& command : Commands()) names.push_back(command.name);
  throw UsageError("found command '" + name + "', expected one of " +
                   JoinNames(names));
}

FlagSession::FlagSession(const Command& command, const FlagTexts& flags)
    : lock_(Wait()) {
  std::vector<std::string> texts = {command.name};
  for (const auto& [name, text] : flags) {
    texts.push_back("--" + name + "=" + text);
  }
  std::vector<char*> arguments;
  for (std::string& text : texts) arguments.push_back(text.data());
  ParseFlags(command, static_cast<int>(arguments.size()), arguments.data());
  in_session = true;
}

FlagSession::~FlagSession() { in_session = false; }

}  // namespace armcal
