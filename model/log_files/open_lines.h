#pragma once

#include <memory>
#include <string>

#include "model/log_files/line_source.h"

namespace armcal {

// By the file's first bytes, never by its name: a ROS 2 bag (bag_source.h),
// also as a folder, NumPy's .npz and MATLAB's .mat (array_source.h), else text,
// plain or gzipped (text_source.h). Throws InputError.
std::unique_ptr<LineSource> OpenLines(const std::string& path,
                                      const LineOptions& options);

}  // namespace armcal
