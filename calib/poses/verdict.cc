#include "calib/poses/verdict.h"

#include <algorithm>

#include "calib/linear/verdict.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Sentences = std::vector<std::string>;

// Share of the poses' extent that the median deviation must not exceed.
constexpr double kMostDeviation = 0.1;

std::string Millimetres(double x) { return Format("%.3g", x); }

}  // namespace

Sentences Shortcomings(const Robot& robot, const PoseCalibration& result) {
  if (!result.solved) return {result.reason};
  Sentences sentences;
  if (result.refined) {
    AddUnmoved(robot, result.travel, "its geometry is not determined",
               &sentences);
  }
  const double deviation = std::max(result.median, result.held_out_median);
  if (deviation > kMostDeviation * result.extent) {
    sentences.push_back("the poses do not follow the joints: they deviate by " +
                        Millimetres(1e3 * deviation) +
                        " mm (median) of an extent of " +
                        Millimetres(1e3 * result.extent) + " mm");
  }
  if (2 * static_cast<int>(result.outliers.size()) > result.count) {
    sentences.push_back(std::to_string(result.outliers.size()) + " of " +
                        std::to_string(result.count) +
                        " poses are outliers to the others");
  }
  return sentences;
}

}  // namespace armcal
