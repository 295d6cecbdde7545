#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/linear/calibration.h"
#include "calib/numerics/block_triangular_factor.h"
#include "calib/numerics/mixed_model.h"

namespace armcal {

// Degrees of freedom of the noise that a calibration of one unit's logs found
// for each joint; `inflation`: of its standard deviations.
double NoiseFreedom(const LinearCalibration& own, double inflation);

// Variances that units' own logs tell (a unit per row, square roots), with so
// many degrees of freedom each (0: unknown), are drawn to the median of all.
void ShrinkNoise(const Eigen::VectorXd& freedom, Eigen::MatrixXd* noise);

// What one log's equations tell, of those joints that are used; its unit and
// time are not set.
UnitEvidence EvidenceOf(const BlockTriangularFactor& factor,
                        const std::vector<bool>& used,
                        const Eigen::VectorXd& noise, double inflation);

}  // namespace armcal
