#include "problems/poses/wire_residual.h"

namespace armcal {

WireResidual::WireResidual(std::shared_ptr<const ArmGeometry> geometry,
                           const Eigen::VectorXd& q, double length,
                           double sigma)
    : geometry_(std::move(geometry)), q_(q), length_(length), sigma_(sigma) {
  set_num_residuals(1);
  *mutable_parameter_block_sizes() = {geometry_->size(), 4};
}

// The length's derivative is the velocity's part along the wire: the rest turns
// the wire and leaves its length as it is, to first order.
bool WireResidual::Evaluate(double const* const* parameters, double* residuals,
                            double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> p_WA(parameters[1]);
  std::vector<ParameterTwist> twists;
  const Eigen::Vector3d p =
      geometry_->ToolPose(q_, parameters[0], &twists).translation();
  const double distance = (p - p_WA).norm();
  // At the anchor itself the direction is undefined; 0 keeps it finite.
  const Eigen::Vector3d direction = distance > 0
                                        ? Eigen::Vector3d((p - p_WA) / distance)
                                        : Eigen::Vector3d::Zero();
  residuals[0] = (distance + parameters[1][3] - length_) / sigma_;
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) {
    for (int k = 0; k < geometry_->size(); ++k) {
      jacobians[0][k] = direction.dot(twists[k].At(p)) / sigma_;
    }
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::Vector3d> d_anchor(jacobians[1]);
    d_anchor = -direction / sigma_;
    jacobians[1][3] = 1 / sigma_;
  }
  return true;
}

}  // namespace armcal
