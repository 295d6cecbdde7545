#pragma once

#include <string>
#include <vector>

#include "tools/flag_values.h"

namespace armcal {

// The result of a command, for those who run it.
struct Output {
  std::string json;                // one document, for programs
  std::string text;                // for people
  std::string verdict;             // how the lines of `text` that hold it begin
  bool positive = true;            // the verdict
  std::vector<std::string> notes;  // of what was read, one sentence each
};

// The text with its notes before it.
std::string TextWithNotes(const Output& output);

// To stdout: the text with its notes, or with --json the document instead, or
// with --quiet nothing; --json and --quiet tell the notes on stderr. Colours
// only on terminals. Throws InputError where stdout does not take it: what was
// not said is no success.
void Print(const Output& output, const FlagValues& flags);

// Text that was asked for as such, help or a list.
void PrintText(const std::string& text);

// One line on stderr: "armcal: " and the message.
void PrintError(const std::string& message);

}  // namespace armcal
