#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/log_files/log.h"
#include "model/log_files/log_array.h"

namespace armcal {

// Where a log is read from: a file (or the folder of a ROS 2 bag), or arrays in
// memory, which are read as those of an .npz file with the same names are.
// Copies share the arrays.
struct LogSource {
  LogSource(std::string path) : name(std::move(path)) {}  // NOLINT: implicit
  LogSource(const char* path) : name(path) {}             // NOLINT: implicit
  // `name` stands for the file at `path` in messages and results.
  LogSource(std::string name, std::string path)
      : name(std::move(name)), file(std::move(path)) {}
  // `name` stands for the log in messages and results.
  LogSource(std::string name, std::vector<LogArray> arrays);
  // The signals that `log` has, as they are: SI units, joints in the robot's
  // order.
  LogSource(std::string name, const Log& log);

  // What is opened.
  const std::string& path() const { return file.empty() ? name : file; }

  std::string name;  // or path
  std::string file;  // path, where it is not `name`
  std::shared_ptr<const std::vector<LogArray>> arrays;  // null: of a file
};

// A source for each path.
std::vector<LogSource> LogFiles(const std::vector<std::string>& paths);

}  // namespace armcal
