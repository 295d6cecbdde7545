#include "tools/manual.h"

#include "tools/command.h"
#include "tools/flag_text.h"

namespace armcal {
namespace {

// Text that roff prints as it is.
std::string Plain(const std::string& text) {
  std::string result = text.find_first_of(".'") == 0 ? "\\&" : "";
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

std::string Section(const std::string& name, const std::string& text) {
  return ".SH " + name + "\n" + text + "\n";
}

std::string Flags(const FlagGroup& group) {
  std::string text = ".PP\n.I " + Plain(group.heading) + "\n";
  for (const std::string& name : group.flags) {
    const FlagText flag(name);
    text +=
        ".TP\n.B " + Plain(flag.Form()) + "\n" + Plain(flag.Sentence()) + "\n";
  }
  return text;
}

std::string Examples(const Command& command) {
  std::string text = ".PP\n.EX\n";
  for (const char* line : command.usage) text += Plain(line) + "\n";
  return text + ".EE\n";
}

std::string AllCommands(const std::vector<Command>& commands) {
  std::string text;
  for (const Command& command : commands) {
    text += ".SS armcal " + std::string(command.name) + "\n" +
            Plain(command.summary) + ".\n";
    // What all of them share stands last in each, and here once, at the end.
    for (size_t k = 0; k + 1 < command.groups.size(); ++k) {
      text += Flags(command.groups[k]);
    }
    text += Examples(command);
  }
  return text + ".SS Flags of every command\n" +
         Flags(commands.front().groups.back());
}

constexpr char kExitStatus[] =
    ".TP\n0\ndone\n.TP\n1\ndone, and the verdict is negative (not solved, not "
    "verified, something wrong was found)\n.TP\n2\nwrong flags\n.TP\n3\na file "
    "that cannot be used, read or written\n.TP\n4\na bug in armcal\n.TP\n130, "
    "143, 129\nended by Ctrl\\-C, SIGTERM, SIGHUP; no file is half written";

constexpr char kEnvironment[] =
    ".TP\n.B NO_COLOR\nset: no colours on terminals\n.TP\n.B CI\nset: no "
    "progress bar\n.TP\n.B TERM\ndumb: neither of them";

}  // namespace

std::string ManualPage(const std::vector<Command>& commands) {
  return ".TH ARMCAL 1 \"\" \"armcal " ARMCAL_VERSION "\" \"User Commands\"\n" +
         Section("NAME",
                 "armcal \\- calibrates a robot arm from its logs and says why "
                 "its simulation differs from it") +
         Section("SYNOPSIS",
                 ".B armcal\n.I COMMAND\n.RB [ \\-\\-flag=value\n\\&...]\n.br\n"
                 ".B armcal help\n.I COMMAND\n.RB [ \\-\\-all ]\n.br\n"
                 ".B armcal completion\n.IR bash | zsh | fish") +
         Section("DESCRIPTION",
                 "From a robot file (URDF or DH table) and logs of its joint "
                 "positions and torques, armcal estimates the arm's dynamics "
                 "and geometry with standard deviations, checks them on other "
                 "logs and against Simbody, and diagnoses what the model "
                 "lacks. Text for people goes to standard output, progress to "
                 "standard error, results for programs to the files in "
                 "\\-\\-out. Units are SI and radians.") +
         Section("COMMANDS", AllCommands(commands)) +
         Section("EXIT STATUS", kExitStatus) +
         Section("ENVIRONMENT", kEnvironment);
}

}  // namespace armcal
