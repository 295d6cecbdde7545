#include "tools/usage.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "model/input_text.h"

namespace armcal {
namespace {

size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row.back();
}

// What a wrong flag type is called in a message.
std::string TypeText(const std::string& gflags_type) {
  if (gflags_type == "double") return "a number";
  if (gflags_type == "bool") return "true or false";
  return gflags_type == "string" ? "a valid value" : "a whole number";
}

void SetFlag(const Command& command, const std::string& name,
             const std::string& value) {
  if (std::count(command.flags.begin(), command.flags.end(), name) == 0) {
    const std::string nearest = NearestName(name, command.flags);
    throw UsageError(
        "unknown flag --" + name + " of armcal " + command.name +
        (nearest.empty() ? "" : "; did you mean --" + nearest + "?") +
        "; see armcal " + command.name + " --help");
  }
  gflags::CommandLineFlagInfo info;
  gflags::GetCommandLineFlagInfo(name.c_str(), &info);
  if (!info.is_default) {
    throw UsageError("--" + name +
                     " is given twice; several values go into one flag, with "
                     "commas between them");
  }
  if (!gflags::SetCommandLineOption(name.c_str(), value.c_str()).empty()) {
    return;
  }
  throw UsageError("--" + name + ": found '" + value + "', expected " +
                   TypeText(info.type));
}

// "0.8", where gflags says 0.80000000000000004.
std::string DefaultText(const gflags::CommandLineFlagInfo& info) {
  return info.type == "double" ? NumberText(std::stod(info.default_value))
                               : info.default_value;
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

std::string NearestName(const std::string& name,
                        const std::vector<std::string>& names) {
  std::string nearest;
  size_t best = 4;
  for (const std::string& candidate : names) {
    const size_t distance = EditDistance(name, candidate);
    if (distance >= std::min(best, candidate.size())) continue;
    best = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string GeneralHelp() {
  std::string text =
      "armcal calibrates a robot arm from its logs.\n\n"
      "usage: armcal COMMAND --flags\n\n";
  for (const Command& command : Commands()) {
    text += "  " + std::string(command.name) +
            std::string(12 - std::string(command.name).size(), ' ') +
            Wrapped(command.summary, 14);
  }
  return text + "\narmcal COMMAND --help lists its flags.\n";
}

std::string CommandHelp(const Command& command) {
  std::string text = "armcal " + std::string(command.name) + " --flags\n\n  " +
                     Wrapped(command.summary, 2) + "\n";
  for (const std::string& flag : command.flags) {
    gflags::CommandLineFlagInfo info;
    gflags::GetCommandLineFlagInfo(flag.c_str(), &info);
    text += "  --" + flag;
    text += flag.size() < 20 ? std::string(20 - flag.size(), ' ')
                             : "\n" + std::string(24, ' ');
    const bool plain = info.default_value.empty();
    text += Wrapped(info.description +
                        (plain ? "" : " (default " + DefaultText(info) + ")"),
                    24);
  }
  return text;
}

void ParseFlags(const Command& command, int argc, char** argv) {
  for (int k = 1; k < argc; ++k) {
    std::string argument = argv[k];
    if (argument.size() < 2 || argument[0] != '-') {
      throw UsageError("'" + argument + "' is not a flag; flags look like " +
                       "--log=FILE");
    }
    argument.erase(0, argument[1] == '-' ? 2 : 1);
    const size_t equals = argument.find('=');
    std::string name = argument.substr(0, equals);
    std::replace(name.begin(), name.end(), '-', '_');
    if (equals != std::string::npos) {
      SetFlag(command, name, argument.substr(equals + 1));
      continue;
    }
    gflags::CommandLineFlagInfo info;
    const bool known = gflags::GetCommandLineFlagInfo(name.c_str(), &info);
    if (known && info.type == "bool") {
      SetFlag(command, name, "true");
    } else if (known && k + 1 < argc) {
      SetFlag(command, name, argv[++k]);
    } else if (known) {
      throw UsageError("--" + name + " needs a value: --" + name + "=VALUE");
    } else {
      SetFlag(command, name, "");
    }
  }
}

}  // namespace armcal
