#include "tools/log_flags.h"

#include "model/robot_files/robot_reader.h"
#include "tools/input_flags.h"

namespace armcal {

LogInput LogInputFromFlags(const CommandInput& input) {
  return {LogFiles(LogsFromFlags(input)), CropFromFlags(input.flags)};
}

LogInput ValidationInputFromFlags(const CommandInput& input) {
  return {LogFiles(ValidationLogsFromFlags(input)),
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
