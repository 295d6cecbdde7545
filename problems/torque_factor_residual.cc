#include "problems/torque_factor_residual.h"

#include <ceres/jet.h>
#include <glog/logging.h>

#include "problems/inertial_coordinates.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Jet10 = ceres::Jet<double, 10>;
using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Matrix10d = Eigen::Matrix<double, 10, 10>;

// V and dV/dc at log-Cholesky coordinates c.
void EvaluateInertial(const double* c, Vector10d* V, Matrix10d* J) {
  Jet10 c_jet[10], V_jet[10];
  for (int k = 0; k < 10; ++k) c_jet[k] = Jet10(c[k], k);
  InertialFromLogCholesky(c_jet, V_jet);
  for (int k = 0; k < 10; ++k) {
    (*V)[k] = V_jet[k].a;
    J->row(k) = V_jet[k].v.transpose();
  }
}

}  // namespace

TorqueFactorResidual::TorqueFactorResidual(const MatrixXd& R, const VectorXd& z,
                                           int num_links,
                                           const std::vector<int>& sizes)
    : R_(R), z_(z), num_links_(num_links) {
  set_num_residuals(static_cast<int>(R.rows()));
  mutable_parameter_block_sizes()->assign(num_links, 10);
  int columns = 10 * num_links;
  for (const int size : sizes) {
    if (size == 0) continue;
    sizes_.push_back(size);
    mutable_parameter_block_sizes()->push_back(size);
    columns += size;
  }
  CHECK_EQ(R.cols(), columns);
}

// r = R theta - z, with theta = [V_1 .. V_n, y]. R and z are the triangular
// factor of all weighted rows: |U theta - tau|^2 = |R theta - z|^2 + constant
// (Golub & Van Loan, 5.3), so a step costs the square of the number of
// parameters, not the length of the logs, and R is no worse conditioned than U.
// The equations are linear in theta; only V(c) bends them, by the chain rule
// dr/dc = R_i dV/dc.
bool TorqueFactorResidual::Evaluate(double const* const* parameters,
                                    double* residuals,
                                    double** jacobians) const {
  Eigen::Map<VectorXd> r(residuals, R_.rows());
  r = -z_;
  for (int i = 0; i < num_links_; ++i) {
    Vector10d V;
    Matrix10d J;
    EvaluateInertial(parameters[i], &V, &J);
    const auto columns = R_.middleCols(10 * i, 10);
    r += columns * V;
    if (jacobians != nullptr && jacobians[i] != nullptr) {
      Eigen::Map<RowMajor>(jacobians[i], R_.rows(), 10) = columns * J;
    }
  }
  int block = num_links_;
  Eigen::Index at = 10 * num_links_;
  for (const int size : sizes_) {
    const auto columns = R_.middleCols(at, size);
    r += columns * Eigen::Map<const VectorXd>(parameters[block], size);
    if (jacobians != nullptr && jacobians[block] != nullptr) {
      Eigen::Map<RowMajor>(jacobians[block], R_.rows(), size) = columns;
    }
    at += size;
    ++block;
  }
  return r.allFinite();
}

}  // namespace armcal
