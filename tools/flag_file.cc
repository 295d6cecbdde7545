#include "tools/flag_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "tools/usage_error.h"

namespace armcal {
namespace {

GivenFlag ParseLine(const std::string& line, const std::string& place) {
  const size_t blank = line.find_first_of(" \t");
  const size_t equals = line.find('=');
  if (line[0] != '-' || (blank != std::string::npos && blank < equals)) {
    throw UsageError(place + "found '" + line + "', expected --flag=value");
  }
  GivenFlag flag = SplitFlag(line);
  flag.place = place;
  if (flag.name == "flagfile") {
    throw UsageError(place + "a flag file cannot name another one");
  }
  return flag;
}

}  // namespace

GivenFlag SplitFlag(std::string argument) {
  argument.erase(0, argument.compare(0, 2, "--") == 0 ? 2 : 1);
  const size_t equals = argument.find('=');
  GivenFlag flag;
  flag.name = argument.substr(0, equals);
  std::replace(flag.name.begin(), flag.name.end(), '-', '_');
  flag.has_value = equals != std::string::npos;
  if (flag.has_value) flag.value = argument.substr(equals + 1);
  return flag;
}

std::vector<GivenFlag> ReadFlagFile(const std::string& path) {
  errno = 0;
  std::ifstream file(path);
  std::vector<GivenFlag> flags;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    line = std::string(Trim(line));
    if (line.empty() || line[0] == '#') continue;
    flags.push_back(
        ParseLine(line, path + ": line " + std::to_string(number) + ": "));
  }
  // A folder opens, and then cannot be read.
  if (!file.is_open() || file.bad()) {
    throw InputError(path, "--flagfile", "",
                     std::string("cannot be read: ") + std::strerror(errno));
  }
  return flags;
}

}  // namespace armcal
