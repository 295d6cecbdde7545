#include "problems/poses/plane_residual.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace armcal {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

double NormalLength(const double* abc) {
  return std::sqrt(1 + abc[0] * abc[0] + abc[1] * abc[1]);
}

// Total least squares: the plane through the mean whose normal, of length 1, is
// the eigenvector of the scatter's least eigenvalue. It minimises distances and
// not heights along an axis, so that no orientation of the plane is special
// (Golub & Van Loan 1980, SIAM J. Numer. Anal. 17).
void FitPlane(const Eigen::Matrix3Xd& p, Vector3d* normal, Vector3d* mean) {
  *mean = p.rowwise().mean();
  const Eigen::Matrix3Xd about = p.colwise() - *mean;
  *normal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(about * about.transpose())
          .eigenvectors()
          .col(0);
}

}  // namespace

Vector3d TouchedPlane::Normal(const double* abc) const {
  Vector3d n;
  n[axis] = 1;
  n[first()] = abc[0];
  n[second()] = abc[1];
  return n / NormalLength(abc);
}

double TouchedPlane::Distance(const double* abc, const Vector3d& p) const {
  return Normal(abc).dot(p) - abc[2] / NormalLength(abc);
}

// The distance is u / s with u = p_k + a p_i + b p_j - c linear and s the
// normal's length, s^2 = 1 + a^2 + b^2. Hence d/da = p_i / s - u a / s^3.
Eigen::RowVector3d TouchedPlane::Derivative(const double* abc,
                                            const Vector3d& p) const {
  const double s = NormalLength(abc), distance = Distance(abc, p);
  return {p[first()] / s - distance * abc[0] / (s * s),
          p[second()] / s - distance * abc[1] / (s * s), -1 / s};
}

// The coordinate that is eliminated is the normal's largest one, so that |a|,
// |b| <= 1 at the start and three numbers describe any plane without a
// constraint. It is chosen once, by the file's geometry, and stays while the
// solver runs.
std::vector<TouchedPlane> TouchedPlanes(const ArmGeometry& geometry,
                                        const PoseMeasurements& measured,
                                        VectorXd* abc) {
  const VectorXd values = geometry.Values();
  std::vector<TouchedPlane> planes(measured.num_points());
  if (abc != nullptr) abc->resize(3 * measured.num_points());
  for (size_t plane = 0; plane < planes.size(); ++plane) {
    Eigen::Matrix3Xd tips(3, 0);
    for (int k = 0; k < measured.size(); ++k) {
      if (measured.touched[k] != static_cast<int>(plane)) continue;
      tips.conservativeResize(3, tips.cols() + 1);
      tips.rightCols<1>() =
          geometry.ToolPose(measured.q.row(k), values.data(), nullptr)
              .translation();
    }
    Vector3d normal, mean;
    FitPlane(tips, &normal, &mean);
    TouchedPlane& own = planes[plane];
    normal.cwiseAbs().maxCoeff(&own.axis);
    if (abc == nullptr) continue;
    normal /= normal[own.axis];
    abc->segment<3>(3 * static_cast<Eigen::Index>(plane))
        << normal[own.first()],
        normal[own.second()], normal.dot(mean);
  }
  return planes;
}

PlaneResidual::PlaneResidual(std::shared_ptr<const ArmGeometry> geometry,
                             const VectorXd& q, const TouchedPlane& plane,
                             double sigma)
    : geometry_(std::move(geometry)), q_(q), plane_(plane), sigma_(sigma) {
  set_num_residuals(1);
  *mutable_parameter_block_sizes() = {geometry_->size(), 3};
}

bool PlaneResidual::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  std::vector<ParameterTwist> twists;
  const Vector3d tip =
      geometry_->ToolPose(q_, parameters[0], &twists).translation();
  residuals[0] = plane_.Distance(parameters[1], tip) / sigma_;
  if (jacobians == nullptr) return true;
  if (jacobians[0] != nullptr) {
    const Vector3d normal = plane_.Normal(parameters[1]);
    for (int k = 0; k < geometry_->size(); ++k) {
      jacobians[0][k] = normal.dot(twists[k].At(tip)) / sigma_;
    }
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Eigen::RowVector3d> J(jacobians[1]);
    J = plane_.Derivative(parameters[1], tip) / sigma_;
  }
  return true;
}

}  // namespace armcal
