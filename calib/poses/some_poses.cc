#include "calib/poses/some_poses.h"

#include <vector>

namespace armcal {

// All that a pose has goes with it: rows, targets, covariances, instrument.
PoseMeasurements SomePoses(const PoseMeasurements& measured, int most) {
  const int step = 1 + (measured.size() - 1) / most;
  if (step == 1) return measured;
  std::vector<int> kept;
  for (int k = 0; k < measured.size(); k += step) kept.push_back(k);
  PoseMeasurements part;
  part.planes = measured.planes;
  part.q = measured.q(kept, Eigen::all);
  for (const int k : kept) part.row.push_back(measured.row[k]);
  for (const int k : kept) {
    if (!measured.number.empty()) part.number.push_back(measured.number[k]);
  }
  for (const Eigen::MatrixXd& target : measured.targets) {
    part.targets.push_back(target(kept, Eigen::all));
  }
  if (measured.poses.size() > 0) part.poses = measured.poses(kept, Eigen::all);
  for (const int k : kept) {
    if (!measured.covariance.empty()) {
      part.covariance.push_back(measured.covariance[k]);
    }
    if (!measured.touched.empty()) part.touched.push_back(measured.touched[k]);
  }
  part.instrument = measured.instrument;
  if (part.instrument.size() > 0) {
    part.instrument.moves.clear();
    for (const int k : kept) {
      part.instrument.moves.push_back(measured.instrument.moves[k]);
    }
  }
  if (measured.tilts.size() > 0) part.tilts = measured.tilts(kept, Eigen::all);
  if (measured.lengths.size() > 0) part.lengths = measured.lengths(kept);
  if (measured.u95.size() > 0) part.u95 = measured.u95(kept, Eigen::all);
  return part;
}

}  // namespace armcal
