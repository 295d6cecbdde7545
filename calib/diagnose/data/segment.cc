#include "calib/diagnose/data/segment.h"

#include <cmath>

namespace armcal {

using Eigen::VectorXd;

VectorXd UsualTorque(const std::vector<GapSegment>& segments,
                     bool of_reconstructed_torques) {
  double samples = 0;
  VectorXd sum;
  for (const GapSegment& segment : segments) {
    if (sum.size() == 0) sum = VectorXd::Zero(segment.tau.cols());
    for (int k = 0; k < segment.size(); ++k) {
      if (segment.IsLost(segment.motion.time(k))) continue;
      ++samples;
      if (of_reconstructed_torques && !segment.reconstructed_torque) continue;
      sum += segment.tau.row(k).cwiseAbs2().transpose();
    }
  }
  return (sum / std::max(1., samples)).cwiseSqrt();
}

bool HaveNoiseOfPositions(const std::vector<GapSegment>& segments) {
  return std::all_of(segments.begin(), segments.end(), [](const GapSegment& s) {
    return s.torque_noise.size() > 0;
  });
}

}  // namespace armcal
