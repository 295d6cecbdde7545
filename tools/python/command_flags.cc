#include "tools/python/command_flags.h"

#include <vector>

#include "model/text/input_text.h"
#include "tools/flag_parser.h"
#include "tools/program/command_list.h"

namespace armcal {

const Command& CommandNamed(const std::string& name) {
  if (const Command* command = FindCommand(name)) return *command;
  std::vector<std::string> names;
  for (const Command& command : Commands()) names.push_back(command.name);
  throw UsageError("found command '" + name + "', expected one of " +
                   JoinNames(names));
}

FlagValues FlagsOf(const Command& command, const FlagTexts& texts) {
  std::vector<std::string> typed = {command.name};
  for (const auto& [name, text] : texts) {
    typed.push_back("--" + name + "=" + text);
  }
  std::vector<char*> arguments;
  for (std::string& text : typed) arguments.push_back(text.data());
  return ParseFlags(command, static_cast<int>(arguments.size()),
                    arguments.data())
      .values;
}

}  // namespace armcal
