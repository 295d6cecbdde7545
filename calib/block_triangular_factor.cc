#include "calib/block_triangular_factor.h"

#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

BlockTriangularFactor::BlockTriangularFactor(const ModelParameters& parameters)
    : num_parameters_(parameters.size()) {
  for (int i = 0; i <= parameters.num_joints(); ++i) {
    block_begin_.push_back(parameters.block_begin(i));
  }
  for (int i = 0; i < parameters.num_joints(); ++i) {
    JointEquations joint;
    joint.columns = parameters.row_columns(i);
    const Eigen::Index k = joint.columns.size() + 1;
    joint.buffer.setZero(k + kChunkRows, k);
    joints_.push_back(std::move(joint));
  }
}

void BlockTriangularFactor::Compress(JointEquations* joint) const {
  if (joint->filled == 0) return;
  const Eigen::Index k = joint->columns.size() + 1;
  Eigen::Ref<MatrixXd> used = joint->buffer.topRows(k + joint->filled);
  const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(used);
  joint->buffer.topRows(k).triangularView<Eigen::StrictlyLower>().setZero();
  joint->filled = 0;
}

void BlockTriangularFactor::Add(int i, const Eigen::RowVectorXd& u, double y,
                                double weight) {
  CHECK_EQ(u.size(), num_parameters_);
  JointEquations& joint = joints_[i];
  const Eigen::Index k = joint.columns.size() + 1;
  auto row = joint.buffer.row(k + joint.filled);
  for (Eigen::Index c = 0; c + 1 < k; ++c) {
    row[c] = weight * u[joint.columns[c]];
  }
  row[k - 1] = weight * y;
  ++joint.rows;
  if (++joint.filled == kChunkRows) Compress(&joint);
}

void BlockTriangularFactor::Merge(const BlockTriangularFactor& other, int i) {
  CHECK_EQ(other.num_parameters_, num_parameters_);
  JointEquations& joint = joints_[i];
  const MatrixXd R = other.Triangle(i);
  for (Eigen::Index r = 0; r < R.rows(); ++r) {
    joint.buffer.row(R.cols() + joint.filled) = R.row(r);
    if (++joint.filled == kChunkRows) Compress(&joint);
  }
  joint.rows += other.rows(i);
}

const MatrixXd& BlockTriangularFactor::Triangle(int i) const {
  JointEquations& joint = joints_[i];
  Compress(&joint);
  triangle_ = joint.buffer.topRows(joint.columns.size() + 1);
  return triangle_;
}

double BlockTriangularFactor::ResidualNorm(int i, const VectorXd& x) const {
  const std::vector<int>& used = columns(i);
  VectorXd z(used.size() + 1);
  for (size_t c = 0; c < used.size(); ++c) z[c] = x[used[c]];
  z[used.size()] = -1;
  return (Triangle(i).triangularView<Eigen::Upper>() * z).norm();
}

VectorXd RightSideRms(const BlockTriangularFactor& factor) {
  VectorXd rms(factor.num_joints());
  for (int i = 0; i < factor.num_joints(); ++i) {
    const double rows = static_cast<double>(std::max(1L, factor.rows(i)));
    rms[i] = factor.Triangle(i).rightCols<1>().norm() / std::sqrt(rows);
  }
  return rms;
}

}  // namespace armcal
