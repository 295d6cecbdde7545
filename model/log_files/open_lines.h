#pragma once

#include <memory>
#include <string>

#include "model/log_files/line_source.h"
#include "model/log_files/log_source.h"

namespace armcal {

// The table of a log in memory (array_source.h), or of a file, which is told by
// its first bytes, never by its name: a ROS 2 bag (bag_source.h),
// also as a folder, NumPy's .npz and MATLAB's .mat (array_source.h), else text,
// plain or gzipped (text_source.h). Throws InputError.
std::unique_ptr<LineSource> OpenLines(const LogSource& log,
                                      const LineOptions& options);

}  // namespace armcal
