#pragma once

#include <pybind11/numpy.h>

#include <map>
#include <string>

#include "model/log_files/log_source.h"

namespace armcal {

// {name: array} of a log, as an .npz file has them.
using PythonLog = std::map<std::string, pybind11::array>;
using PythonLogs = std::map<std::string, PythonLog>;

// Logs that Python has in memory, by name; their numbers are copied once.
// ValueError names an array that is not of one or two dimensions.
std::map<std::string, LogSource> LogSources(const PythonLogs& logs);

}  // namespace armcal
