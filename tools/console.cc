#include "tools/console.h"

#include <gflags/gflags.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "model/text/input_error.h"
#include "tools/progress_bar.h"
#include "tools/terminal.h"

DEFINE_bool(json, false, "the result's JSON on stdout instead of text");
DEFINE_bool(quiet, false, "no text on stdout; errors are on stderr as ever");

namespace armcal {
namespace {

constexpr char kGood[] = "\x1b[1;32m";   // bold green
constexpr char kBad[] = "\x1b[1;31m";    // bold red
constexpr char kWarning[] = "\x1b[33m";  // yellow
constexpr char kNoColour[] = "\x1b[0m";

bool BeginsWith(const std::string& line, const std::string& begin) {
  return line.compare(0, begin.size(), begin) == 0;
}

// The colour of a line, empty for none. inspect marks its findings with "!".
std::string ColourOf(const std::string& line, const Output& output) {
  if (!output.verdict.empty() && BeginsWith(line, output.verdict)) {
    return output.positive ? kGood : kBad;
  }
  const bool warns = BeginsWith(line, "note ") || BeginsWith(line, "  ! ");
  return warns ? kWarning : "";
}

std::string Coloured(const std::string& text, const Output& output) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const std::string colour = ColourOf(line, output);
    result += colour.empty() ? line + "\n" : colour + line + kNoColour + "\n";
  }
  return result;
}

}  // namespace

void PrintText(const std::string& text) {
  EndProgress();
  errno = 0;
  const size_t written = std::fwrite(text.data(), 1, text.size(), stdout);
  if (written == text.size() && std::fflush(stdout) == 0) return;
  throw InputError("standard output", "", "",
                   std::string("cannot be written: ") + std::strerror(errno));
}

std::string TextWithNotes(const Output& output) {
  std::string text;
  for (const std::string& note : output.notes) {
    text += "note       " + note + "\n";
  }
  return text + output.text;
}

void Print(const Output& output, const FlagValues& flags) {
  EndProgress();
  if (flags.Switch("json") || flags.Switch("quiet")) {
    for (const std::string& note : output.notes) PrintError("note: " + note);
  }
  if (flags.Switch("json")) {
    PrintText(output.json);
  } else if (!flags.Switch("quiet")) {
    const std::string text = TextWithNotes(output);
    PrintText(TakesColour(STDOUT_FILENO) ? Coloured(text, output) : text);
  }
}

void PrintError(const std::string& message) {
  EndProgress();
  const bool colour = TakesColour(STDERR_FILENO);
  const std::string name = colour ? std::string(kBad) + "armcal:" + kNoColour
                                  : std::string("armcal:");
  std::fprintf(stderr, "%s %s\n", name.c_str(), message.c_str());
}

}  // namespace armcal
