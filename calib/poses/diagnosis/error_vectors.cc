#include "calib/poses/diagnosis/error_vectors.h"

#include "calib/poses/diagnosis/displaced_pose.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Residuals are turned to the base frame, in which a sag points down and people
// think.
PoseErrorVectors ErrorVectorsOf(const PoseMeasurements& measured,
                                const PoseDiagnosis& diagnosis) {
  PoseErrorVectors errors;
  if (measured.lengths.size() > 0) return errors;
  const bool whole = measured.poses.size() > 0;
  const auto targets =
      whole ? 1 : static_cast<Eigen::Index>(measured.targets.size());
  const Eigen::Index width = whole ? 6 : 3 * targets;
  const auto count = targets * measured.size();
  errors.at.resize(count, 3);
  errors.geometry.resize(count, 3);
  errors.after.resize(count, 3);
  // What an instrument measures is seen from the base as the effects' model
  // has it.
  const Isometry3d X_BW =
      BasePose(diagnosis.model.estimate.state.unknowns.geometry).inverse();
  for (Eigen::Index k = 0; k < measured.size(); ++k) {
    for (Eigen::Index t = 0; t < targets; ++t) {
      const Vector3d p =
          whole ? Vector3d(measured.poses.row(k).head<3>().transpose())
                : Vector3d(measured.targets[t].row(k).transpose());
      const auto turned = [&](const Eigen::VectorXd& r) {
        const Vector3d own = r.segment<3>(k * width + 3 * t);
        return (X_BW.linear() * own).transpose().eval();
      };
      const Eigen::Index row = k * targets + t;
      errors.at.row(row) = (X_BW * p).transpose();
      errors.geometry.row(row) = turned(diagnosis.left_by_geometry);
      errors.after.row(row) = turned(diagnosis.model.estimate.linear.r);
    }
  }
  return errors;
}

}  // namespace armcal
