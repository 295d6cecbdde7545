#include "model/dynamics/geometry_jacobian.h"

#include <glog/logging.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "model/dynamics/regressor_plan.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

void Copy(const Vector3d& v, double* to) { std::copy_n(v.data(), 3, to); }

simd::GeometricParameter MakeParameter(const CarriedTwist& at, int place) {
  simd::GeometricParameter parameter{};
  parameter.link = at.link;
  parameter.with_body = at.with_body;
  parameter.rotation = at.twist.rotation;
  Copy(at.twist.axis, parameter.axis);
  Copy(at.twist.origin, parameter.origin);
  parameter.place = place;
  return parameter;
}

// The inertia J = tr(S) - S of the second moments S = sum m x x'.
simd::BodyMoments MakeBody(const InertialParameters& V) {
  simd::BodyMoments body{};
  body.mass = V.mass;
  Copy(V.first_moment, body.first);
  const Matrix3d S = V.inertia.trace() / 2 * Matrix3d::Identity() - V.inertia;
  int k = 0;
  for (int row = 0; row < 3; ++row) {
    for (int col = row; col < 3; ++col) body.second[k++] = S(row, col);
  }
  return body;
}

std::vector<CarriedTwist> Chosen(const ArmGeometry& geometry,
                                 const std::vector<int>& parameters) {
  const std::vector<CarriedTwist> all = geometry.CarriedTwists();
  std::vector<CarriedTwist> chosen;
  for (const int k : parameters) chosen.push_back(all.at(k));
  return chosen;
}

// Of the rows of a matrix with columns n apart, or of a vector, each.
template <class Matrix>
auto Entries(Matrix& of) {
  std::vector<decltype(of.data())> rows(of.rows());
  std::iota(rows.begin(), rows.end(), of.data());
  return rows;
}

}  // namespace

GeometryJacobian::GeometryJacobian(const Robot& robot,
                                   const ArmGeometry& geometry,
                                   const std::vector<int>& parameters,
                                   const simd::Kernels& kernels)
    : GeometryJacobian(geometry.ApplyTo(robot), Chosen(geometry, parameters),
                       kernels) {}

GeometryJacobian::GeometryJacobian(const Robot& robot,
                                   const std::vector<CarriedTwist>& twists,
                                   const simd::Kernels& kernels)
    : plan_(
          std::make_shared<RegressorPlan>(robot, RegressorPlan::Places::kNone)),
      row_sizes_(robot.links.size(), static_cast<int>(twists.size())),
      kernels_(&kernels) {
  for (const CarriedTwist& twist : twists) {
    parameters_.push_back(MakeParameter(twist, size()));
  }
  std::stable_sort(parameters_.begin(), parameters_.end(),
                   [](const auto& a, const auto& b) {
                     return std::make_tuple(-a.link, a.with_body) <
                            std::make_tuple(-b.link, b.with_body);
                   });
  for (const Link& link : robot.links) {
    bodies_.push_back(MakeBody(link.inertial));
  }
}

std::vector<CarriedTwist> JointTwists(const Robot& robot) {
  std::vector<CarriedTwist> twists;
  for (int j = 0; j < robot.num_joints(); ++j) {
    const Link& link = robot.links[j];
    const Eigen::Isometry3d X_LM = link.X_ML.inverse();
    twists.push_back({j,
                      true,
                      {X_LM.linear().col(2), X_LM.translation(),
                       IsRotational(link.joint.type)}});
  }
  return twists;
}

int GeometryJacobian::num_joints() const { return plan_->num_joints(); }

simd::ChainConstants GeometryJacobian::Chain() const {
  simd::ChainConstants chain = plan_->chain();
  chain.row_sizes = row_sizes_.data();
  return chain;
}

simd::GeometryConstants GeometryJacobian::Constants() const {
  return {size(), parameters_.data(), bodies_.data()};
}

void GeometryJacobian::Torque(const MotionColumns& motion, long count,
                              double* const* out, long stride) const {
  CHECK_EQ(motion.qdd.size(), num_joints());
  kernels_->torque_geometry(
      Chain(), Constants(),
      {motion.q.data(), motion.qd.data(), motion.qdd.data()}, count, out,
      stride);
}

void GeometryJacobian::Momentum(const MotionColumns& motion, long count,
                                double* const* P, double* const* D,
                                long stride) const {
  kernels_->momentum_geometry(Chain(), Constants(),
                              {motion.q.data(), motion.qd.data(), nullptr},
                              count, P, D, stride);
}

MatrixXd GeometryJacobian::Torque(const VectorXd& q, const VectorXd& qd,
                                  const VectorXd& qdd) const {
  const int n = num_joints();
  CHECK(q.size() == n && qd.size() == n && qdd.size() == n);
  MatrixXd J(n, size());
  kernels_->torque_geometry_of_one(
      Chain(), Constants(),
      {Entries(q).data(), Entries(qd).data(), Entries(qdd).data()}, 0,
      Entries(J).data(), n);
  return J;
}

void GeometryJacobian::Momentum(const VectorXd& q, const VectorXd& qd,
                                MatrixXd* P, MatrixXd* D) const {
  const int n = num_joints();
  CHECK(q.size() == n && qd.size() == n);
  P->resize(n, size());
  D->resize(n, size());
  kernels_->momentum_geometry_of_one(
      Chain(), Constants(), {Entries(q).data(), Entries(qd).data(), nullptr}, 0,
      Entries(*P).data(), Entries(*D).data(), n);
}

}  // namespace armcal
