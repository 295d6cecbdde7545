#include "tools/log_flags.h"

#include "model/robot_files/robot_reader.h"
#include "tools/input_flags.h"

namespace armcal {

LogSource SourceOf(const CommandInput& input, const std::string& name) {
  const auto log = input.logs.find(name);
  if (log != input.logs.end()) return log->second;
  return LogSource(name, input.pipes->PathOf(name));
}

std::vector<LogSource> SourcesOf(const CommandInput& input,
                                 const std::vector<std::string>& names) {
  std::vector<LogSource> sources;
  for (const std::string& name : names) {
    sources.push_back(SourceOf(input, name));
  }
  return sources;
}

LogInput LogInputFromFlags(const CommandInput& input) {
  return {SourcesOf(input, LogsFromFlags(input)), CropFromFlags(input.flags)};
}

LogInput ValidationInputFromFlags(const CommandInput& input) {
  return {SourcesOf(input, ValidationLogsFromFlags(input)),
          ValidationCropFromFlags(input.flags)};
}

RobotSource RobotSourceFromFlags(const CommandInput& input) {
  const Document file = RobotFileFromFlags(input);
  RobotSource source;
  source.name = file.name();
  source.base = BaseFromFlags(input.flags);
  if (KindOfRobotFile(file) == RobotFileKind::kUrdf) source.urdf = file;
  return source;
}

}  // namespace armcal
