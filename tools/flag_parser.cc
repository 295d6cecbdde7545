#include "tools/flag_parser.h"

#include <gflags/gflags.h>

#include <algorithm>

#include "tools/flag_file.h"
#include "tools/nearest_name.h"

namespace armcal {
namespace {

using GivenFlags = std::vector<GivenFlag>;

bool Holds(const std::vector<std::string>& names, const std::string& name) {
  return std::count(names.begin(), names.end(), name) > 0;
}

bool IsSwitch(const std::string& name) {
  return gflags::GetCommandLineFlagInfoOrDie(name.c_str()).type == "bool";
}

void CheckName(const Command& command, const GivenFlag& flag) {
  const std::vector<std::string> names = command.FlagNames();
  if (Holds(names, flag.name)) return;
  throw UsageError(flag.place + "unknown flag --" + flag.name + " of armcal " +
                   command.name + DidYouMean(flag.name, names, "--") +
                   "; see armcal " + command.name + " --help");
}

// "--forward" and "--noforward" are values.
void CompleteSwitch(const Command& command, GivenFlag* flag) {
  if (flag->has_value) return;
  const std::vector<std::string> names = command.FlagNames();
  const bool no = !Holds(names, flag->name) && flag->name.rfind("no", 0) == 0 &&
                  Holds(names, flag->name.substr(2)) &&
                  IsSwitch(flag->name.substr(2));
  if (no) flag->name.erase(0, 2);
  if (!Holds(names, flag->name) || !IsSwitch(flag->name)) return;
  flag->value = no ? "false" : "true";
  flag->has_value = true;
}

void CheckOnce(const GivenFlags& flags, const GivenFlag& flag) {
  for (const GivenFlag& before : flags) {
    if (before.name != flag.name) continue;
    throw UsageError(flag.place + "--" + flag.name +
                     " is given twice; several values go into one flag, with "
                     "commas between them");
  }
}

// Of names that the command has, each once, with values.
void Add(const Command& command, GivenFlag flag, GivenFlags* flags) {
  CompleteSwitch(command, &flag);
  CheckName(command, flag);
  CheckOnce(*flags, flag);
  if (!flag.has_value) {
    throw UsageError(flag.place + "--" + flag.name + " needs a value: --" +
                     flag.name + "=VALUE");
  }
  flags->push_back(flag);
}

bool IsFlag(const std::string& argument) {
  return argument.size() >= 2 && argument[0] == '-';
}

// Words without dashes, one value with commas between them.
void AddWord(const Command& command, const std::string& word,
             GivenFlag* words) {
  if (command.words_of == nullptr) {
    throw UsageError("'" + word + "' is not a flag; flags look like " +
                     "--log=FILE, several files like --log=FILE,FILE");
  }
  words->name = command.words_of;
  words->value += (words->has_value ? "," : "") + word;
  words->has_value = true;
}

GivenFlags OfCommandLine(const Command& command, int argc, char** argv) {
  const std::vector<std::string> names = command.FlagNames();
  GivenFlags flags;
  GivenFlag words;
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    if (!IsFlag(argument)) {
      AddWord(command, argument, &words);
      continue;
    }
    GivenFlag flag = SplitFlag(argument);
    const bool value_follows = !flag.has_value && Holds(names, flag.name) &&
                               !IsSwitch(flag.name) && k + 1 < argc;
    if (value_follows) {
      flag.value = argv[++k];
      flag.has_value = true;
    }
    Add(command, flag, &flags);
  }
  if (words.has_value) Add(command, words, &flags);
  return flags;
}

GivenFlags OfFile(const Command& command, const std::string& path) {
  GivenFlags flags;
  for (const GivenFlag& flag : ReadFlagFile(path)) Add(command, flag, &flags);
  return flags;
}

}  // namespace

ParsedFlags ParseFlags(const Command& command, int argc, char** argv) {
  const GivenFlags typed = OfCommandLine(command, argc, argv);
  GivenFlags given;
  ParsedFlags parsed;
  for (const GivenFlag& flag : typed) {
    if (flag.name != "flagfile") continue;
    given = OfFile(command, flag.value);
    for (const GivenFlag& of_file : given) {
      parsed.places[of_file.name] = of_file.place;
    }
  }
  for (const GivenFlag& flag : typed) {
    if (flag.name == "flagfile") continue;  // it has no value of its own
    given.push_back(flag);
    parsed.places.erase(flag.name);
  }
  parsed.values = FlagValues(command.FlagNames(), given);
  return parsed;
}

}  // namespace armcal
