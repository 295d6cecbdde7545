#pragma once

#include <Eigen/Core>
#include <string>

namespace armcal {

// The symmetric matrix of a CSV that a calibration wrote: a line of names, then
// `size` rows of as many numbers. A field that is empty, of what the logs do
// not tell, is NaN. Throws InputError where the file is not so.
Eigen::MatrixXd ReadCovarianceCsv(const std::string& path, int size);

}  // namespace armcal
