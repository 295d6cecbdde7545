#include "calib/refine/covariance_file.h"

#include <cmath>
#include <sstream>

#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Reads `size` rows of `size` numbers below a line of names; empty is NaN.
MatrixXd ReadRows(const std::string& path, int size) {
  constexpr long kMaxBytes = 16L << 20;
  std::istringstream lines(ReadTextFile(path, kMaxBytes));
  std::string line, cell;
  std::getline(lines, line);  // names
  MatrixXd matrix(size, size);
  for (int r = 0; r < size; ++r) {
    const std::string row = "row " + std::to_string(r + 2);
    if (!std::getline(lines, line)) {
      throw InputError(path, row, "",
                       "expected " + std::to_string(size) +
                           " rows below the names, one per parameter");
    }
    std::istringstream cells(line + ",");
    for (int c = 0; c < size; ++c) {
      std::getline(cells, cell, ',');
      const auto number = cell.empty() ? std::nan("") : ParseNumber(cell);
      if (!cells || !number || std::isinf(*number)) {
        throw InputError(path, row + ", column " + std::to_string(c + 1),
                         OneLine(cell), "expected a number or nothing");
      }
      matrix(r, c) = *number;
    }
  }
  return matrix;
}

}  // namespace

// Checks that the matrix is symmetric. Rounding is of the size of the
// variances, sqrt(C_rr C_cc), whatever the entry's own size is; a field is as
// empty as its mirror image.
MatrixXd ReadCovarianceCsv(const std::string& path, int size) {
  constexpr double kRounding = 1e-9;
  const MatrixXd matrix = ReadRows(path, size);
  const VectorXd scale = matrix.diagonal().cwiseAbs().cwiseSqrt();
  for (int r = 0; r < size; ++r) {
    for (int c = 0; c < r; ++c) {
      const double difference = std::abs(matrix(r, c) - matrix(c, r));
      const bool same = std::isnan(matrix(r, c)) == std::isnan(matrix(c, r)) &&
                        !(difference > kRounding * scale[r] * scale[c]);
      if (!same) {
        throw InputError(path, "", "",
                         "expected a symmetric matrix below the names");
      }
    }
  }
  return matrix;
}

}  // namespace armcal
