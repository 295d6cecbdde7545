#include "tools/flag_text.h"

#include <gflags/gflags.h>

#include <algorithm>

#include "model/text/input_text.h"
#include "tools/flag_choices.h"

namespace armcal {
namespace {

// gflags has defined this one, and would read the file itself.
constexpr char kFlagFile[] = "`FILE` more flags, one --flag=value a line";

std::string PlainValue(const gflags::CommandLineFlagInfo& info) {
  if (info.type == "bool") return "";
  if (!WordsOf(info.name).words.empty()) return "WORD";
  return info.type == "string" ? "TEXT" : "NUMBER";
}

// "0.8", where gflags says 0.80000000000000004.
std::string DefaultText(const gflags::CommandLineFlagInfo& info) {
  return info.type == "double" ? NumberText(std::stod(info.default_value))
                               : info.default_value;
}

}  // namespace

FlagText::FlagText(const std::string& flag) : name(flag) {
  const auto info = gflags::GetCommandLineFlagInfoOrDie(flag.c_str());
  description = flag == "flagfile" ? kFlagFile : info.description;
  // As in Go's flag package: the value's form is what is in backquotes. In
  // front it is no part of the sentence.
  const size_t begin = description.find('`');
  const size_t end =
      begin == std::string::npos ? begin : description.find('`', begin + 1);
  value = end == std::string::npos
              ? PlainValue(info)
              : description.substr(begin + 1, end - begin - 1);
  if (begin == 0) description = description.substr(end + 2);
  description.erase(std::remove(description.begin(), description.end(), '`'),
                    description.end());
  if (info.type != "bool" || info.default_value != "false") {
    default_value = DefaultText(info);
  }
}

std::string FlagText::Form() const {
  return "--" + name + (value.empty() ? "" : "=" + value);
}

std::string FlagText::Sentence() const {
  return description +
         (default_value.empty() ? "" : " (default " + default_value + ")");
}

}  // namespace armcal
