#include "tools/usage.h"

#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "tools/flag_text.h"
#include "tools/terminal.h"

namespace armcal {
namespace {

constexpr size_t kFlagColumn = 24;

size_t Width() { return std::clamp(TerminalWidth(STDOUT_FILENO), 80, 120); }

// `left`, indented by two, and `right` from `column` on.
std::string Entry(const std::string& left, const std::string& right,
                  size_t column) {
  std::string text = "  " + left;
  text += text.size() < column ? std::string(column - text.size(), ' ')
                               : "\n" + std::string(column, ' ');
  return text + Wrapped(right, column, Width());
}

std::string Explained(const FlagGroup& group) {
  std::string text = "\n" + group.heading + "\n";
  for (const std::string& name : group.flags) {
    const FlagText flag(name);
    text += Entry(flag.Form(), flag.Sentence(), kFlagColumn);
  }
  return text;
}

std::string Named(const FlagGroup& group) {
  std::string names;
  for (const std::string& flag : group.flags) names += " --" + flag;
  return Entry(group.heading, names, kFlagColumn);
}

}  // namespace

std::string Wrapped(const std::string& text, size_t column, size_t width) {
  std::istringstream words(text);
  std::string result, word;
  size_t at = column;
  while (words >> word) {
    if (at > column && at + 1 + word.size() > width) {
      result += "\n" + std::string(column, ' ');
      at = column;
    } else if (at > column) {
      result += " ";
      ++at;
    }
    result += word;
    at += word.size();
  }
  return result + "\n";
}

std::string GeneralHelp(const std::vector<Command>& commands) {
  constexpr size_t kColumn = 14;
  std::string text =
      "armcal calibrates a robot arm from its logs.\n\n"
      "usage: armcal COMMAND --flags\n\n";
  for (const Command& command : commands) {
    text += Entry(command.name, command.summary, kColumn);
  }
  text += Entry("completion",
                "prints what completes command lines in a shell: "
                "armcal completion bash, zsh or fish",
                kColumn);
  return text +
         "\narmcal COMMAND --help lists its flags, and --helpfull all of "
         "them.\narmcal --version tells versions. Exit codes: 0 done, 1 done "
         "and the verdict is\nnegative, 2 wrong flags, 3 a file that cannot be "
         "used, 4 a bug in armcal.\n";
}

std::string CommandHelp(const Command& command, bool all) {
  const std::string name = command.name;
  std::string text = "usage: armcal " + name + " --flags\n\n" +
                     Wrapped(command.summary, 0, Width());
  std::string others;
  for (const FlagGroup& group : command.groups) {
    if (all || group.usual) {
      text += Explained(group);
    } else {
      others += Named(group);
    }
  }
  if (!others.empty()) {
    text += "\nmore, explained by armcal " + name + " --helpfull\n" + others;
  }
  text += "\nexamples\n";
  for (const char* line : command.usage)
    text += "  " + std::string(line) + "\n";
  return text;
}

}  // namespace armcal
