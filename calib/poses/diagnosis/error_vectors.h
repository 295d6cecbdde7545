#pragma once

#include <Eigen/Core>

#include "calib/poses/diagnosis/diagnosis.h"

namespace armcal {

// Where measured points are and by how much they miss the model's, in the base
// frame, m; a row per target, pose by pose. Of a wire's lengths there are none.
struct PoseErrorVectors {
  Eigen::MatrixX3d at;        // measured
  Eigen::MatrixX3d geometry;  // model minus measured, by the geometry alone
  Eigen::MatrixX3d after;     // the same with the effects
};
PoseErrorVectors ErrorVectorsOf(const PoseMeasurements& measured,
                                const PoseDiagnosis& diagnosis);

}  // namespace armcal
