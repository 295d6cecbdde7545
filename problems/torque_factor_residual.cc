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
                                           int num_links, int num_terms,
                                           const VectorXd& g_0)
    : R_(R), z_(z), g_0_(g_0), num_links_(num_links), num_terms_(num_terms) {
  CHECK_EQ(R.cols(), 10 * num_links + num_terms + g_0.size());
  set_num_residuals(static_cast<int>(R.rows()));
  mutable_parameter_block_sizes()->assign(num_links, 10);
  if (num_terms > 0) mutable_parameter_block_sizes()->push_back(num_terms);
  if (g_0.size() > 0) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(g_0.size()));
  }
}

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
  const auto add_linear = [&](Eigen::Index size, const VectorXd& origin) {
    if (size == 0) return;
    const auto columns = R_.middleCols(at, size);
    r += columns *
         (Eigen::Map<const VectorXd>(parameters[block], size) - origin);
    if (jacobians != nullptr && jacobians[block] != nullptr) {
      Eigen::Map<RowMajor>(jacobians[block], R_.rows(), size) = columns;
    }
    at += size;
    ++block;
  };
  add_linear(num_terms_, VectorXd::Zero(num_terms_));
  add_linear(g_0_.size(), g_0_);
  return r.allFinite();
}

}  // namespace armcal
