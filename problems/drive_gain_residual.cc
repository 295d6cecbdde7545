#include "problems/drive_gain_residual.h"

#include <glog/logging.h>

namespace armcal {

using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

DriveGainResidual::DriveGainResidual(
    const std::vector<CurrentEquations>& equations, int num_joints,
    const MatrixXd& B)
    : equations_(equations), num_joints_(num_joints), B_(B) {
  CHECK_EQ(B.cols(), 10);
  int rows = 0;
  for (const CurrentEquations& e : equations_) {
    CHECK_EQ(e.A.cols(), B.rows());
    rows += static_cast<int>(e.A.rows());
  }
  set_num_residuals(rows);
  *mutable_parameter_block_sizes() = {num_joints, static_cast<int>(B.rows()),
                                      10};
}

// The residual is bilinear: r = g_j A (x + B p) - z. Its derivatives are
//   dr/dg_j = A (x + B p),  dr/dx = g_j A,  dr/dp = g_j A B,
// the last one only with the payload. A and z are triangular factors of all
// rows (QR), so that an evaluation does not grow with the length of a log. Only
// the known payload ends the freedom of scale between g and (x, p): without it
// motion tells torques in units of a drive's constant and no more (Gautier &
// Briot 2014, Global identification of joint drive gains and dynamic parameters
// of robots, ASME J. Dyn. Syst. Meas. Control 136).
bool DriveGainResidual::Evaluate(double const* const* parameters,
                                 double* residuals, double** jacobians) const {
  const Map<const VectorXd> g(parameters[0], num_joints_);
  const Map<const VectorXd> x(parameters[1], B_.rows());
  const Map<const VectorXd> p(parameters[2], 10);
  const int rows = num_residuals();
  const auto jacobian = [&](int block, Eigen::Index columns) {
    const bool wanted = jacobians != nullptr && jacobians[block] != nullptr;
    return Map<RowMajor>(wanted ? jacobians[block] : nullptr, wanted ? rows : 0,
                         wanted ? columns : 0);
  };
  Map<RowMajor> by_g = jacobian(0, num_joints_);
  Map<RowMajor> by_x = jacobian(1, B_.rows());
  Map<RowMajor> by_p = jacobian(2, 10);
  by_g.setZero();
  by_p.setZero();
  const VectorXd loaded = x + B_ * p;
  Eigen::Index at = 0;
  for (const CurrentEquations& e : equations_) {
    const Eigen::Index k = e.A.rows();
    const VectorXd torque = e.loaded ? VectorXd(e.A * loaded) : e.A * x;
    Map<VectorXd>(residuals + at, k) = g[e.joint] * torque - e.z;
    if (by_g.size() > 0) by_g.col(e.joint).segment(at, k) = torque;
    if (by_x.size() > 0) by_x.middleRows(at, k) = g[e.joint] * e.A;
    if (by_p.size() > 0 && e.loaded) {
      by_p.middleRows(at, k) = g[e.joint] * e.A * B_;
    }
    at += k;
  }
  return true;
}

}  // namespace armcal
