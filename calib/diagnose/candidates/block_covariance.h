#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/rows.h"

namespace armcal {

using RowMajorMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Which block of time each row is in, joint by joint as residuals have them:
// blocks are as long as the filters bend signals at an end
// (GapRows::kPeriodsAtEnds), so that what noise has in one hardly depends on
// the next. Numbered from 0 over all segments, gaps included.
std::vector<int> BlocksOfRows(const GapRows& rows);

// The covariance C of a least-squares estimate whose residual r (whitened) is
// no white noise: what a model lacks is alike from sample to sample, on all
// joints, and many samples then tell as little as a few. With the scores of
// blocks of time s_b = sum of J_i' r_i over b's rows,
//   C = H^-1 M H^-1,  H = J' J,  M = B / (B - p) sum_b s_b s_b'
// of B blocks and p parameters (Liang and Zeger 1986; Cameron and Miller 2015,
// who cluster by group what is here clustered by time), but in no direction
// less than H^-1, which noise alone gives. That alone where blocks are no more
// than parameters. J: residual by parameter; rows beyond the blocks' are of a
// prior and of other data. Parameters on which nothing depends have no
// variance; nothing has where a number is not finite.
Eigen::MatrixXd BlockCovariance(const RowMajorMatrix& J,
                                const Eigen::VectorXd& residual,
                                const std::vector<int>& block_of_row);

}  // namespace armcal
