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

simd::GeometricParameter MakeParameter(const CarriedTwist& at, int link,
                                       int place) {
  simd::GeometricParameter parameter{};
  parameter.link = link;
  parameter.with_body = at.with_body;
  parameter.rotation = at.twist.rotation;
  Copy(at.twist.axis, parameter.axis);
  Copy(at.twist.origin, parameter.origin);
  parameter.place = place;
  return parameter;
}

// Those that displace something on the path, with its links' places, in the
// kernels' order.
std::vector<simd::GeometricParameter> ParametersOf(
    const LinkPath& path, const std::vector<CarriedTwist>& twists) {
  std::vector<simd::GeometricParameter> parameters;
  for (int p = 0; p < static_cast<int>(twists.size()); ++p) {
    const CarriedTwist& twist = twists[p];
    const auto place = [&path](int link) {
      const auto at = std::find(path.links.begin(), path.links.end(), link);
      return at == path.links.end() ? -1
                                    : static_cast<int>(at - path.links.begin());
    };
    const int link = place(twist.link);
    if (twist.link >= 0 && link < 0) continue;
    if (twist.next >= 0 && place(twist.next) < 0) continue;
    parameters.push_back(MakeParameter(twist, link, p));
  }
  std::stable_sort(parameters.begin(), parameters.end(),
                   [](const auto& a, const auto& b) {
                     return std::make_tuple(-a.link, a.with_body) <
                            std::make_tuple(-b.link, b.with_body);
                   });
  return parameters;
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
      size_(static_cast<int>(twists.size())),
      row_sizes_(robot.links.size(), size_),
      kernels_(&kernels) {
  for (const RegressorPlan::Path& path : plan_->paths()) {
    paths_.push_back({ParametersOf(path.links, twists), {}});
    const std::vector<int>& links = path.links.links;
    for (size_t k = 0; k < links.size(); ++k) {
      const bool own = static_cast<int>(k) >= path.links.first_own;
      paths_.back().bodies.push_back(
          own ? MakeBody(robot.links[links[k]].inertial) : simd::BodyMoments{});
    }
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

// evaluate(chain, geometry, motion, rows, more_rows) of each path, whose rows
// are added to those of `out` and `more`: `count` samples of size() columns a
// stride apart. More than one path writes to rows of its own first.
template <class Evaluate>
void GeometryJacobian::SumPaths(const simd::ChainMotion& motion, long count,
                                double* const* out, double* const* more,
                                long stride, const Evaluate& evaluate) const {
  auto at = paths_.begin();
  const bool sole = paths_.size() == 1;
  if (!sole) {
    for (int i = 0; i < num_joints(); ++i) {
      for (int c = 0; c < size(); ++c) {
        std::fill_n(out[i] + c * stride, count, 0.);
        if (more != nullptr) std::fill_n(more[i] + c * stride, count, 0.);
      }
    }
  }
  plan_->ForEachPath(
      motion, out, more,
      [&](simd::ChainConstants chain, auto& some, auto* to, auto* to_more) {
        const PathGeometry& path = *at++;
        chain.row_sizes = row_sizes_.data();
        const auto columns = static_cast<int>(path.parameters.size());
        const simd::GeometryConstants geometry = {
            columns, path.parameters.data(), path.bodies.data()};
        if (sole) {
          evaluate(chain, geometry, some, to, to_more, stride);
          return;
        }
        MatrixXd values = MatrixXd::Zero(count, 2 * chain.num_links * size());
        std::vector<double*> rows;
        for (int i = 0; i < 2 * chain.num_links; ++i) {
          rows.push_back(values.data() + i * size() * count);
        }
        evaluate(chain, geometry, some, rows.data(),
                 rows.data() + chain.num_links, count);
        for (int i = 0; i < 2 * chain.num_links; ++i) {
          if (i >= chain.num_links && to_more == nullptr) break;
          double* const row =
              i < chain.num_links ? to[i] : to_more[i - chain.num_links];
          for (int c = 0; c < size(); ++c) {
            Eigen::Map<VectorXd>(row + c * stride, count) +=
                values.col(i * size() + c);
          }
        }
      });
}

void GeometryJacobian::Torque(const MotionColumns& motion, long count,
                              double* const* out, long stride) const {
  CHECK_EQ(motion.qdd.size(), num_joints());
  SumPaths({motion.q.data(), motion.qd.data(), motion.qdd.data()}, count, out,
           nullptr, stride,
           [&](auto& chain, auto& geometry, auto& of_path, auto* rows, auto*,
               long apart) {
             kernels_->torque_geometry(chain, geometry, of_path, count, rows,
                                       apart);
           });
}

void GeometryJacobian::Momentum(const MotionColumns& motion, long count,
                                double* const* P, double* const* D,
                                long stride) const {
  SumPaths({motion.q.data(), motion.qd.data(), nullptr}, count, P, D, stride,
           [&](auto& chain, auto& geometry, auto& of_path, auto* rows,
               auto* more, long apart) {
             kernels_->momentum_geometry(chain, geometry, of_path, count, rows,
                                         more, apart);
           });
}

MatrixXd GeometryJacobian::Torque(const VectorXd& q, const VectorXd& qd,
                                  const VectorXd& qdd) const {
  const int n = num_joints();
  CHECK(q.size() == n && qd.size() == n && qdd.size() == n);
  MatrixXd J(n, size());
  const auto at_q = Entries(q), at_qd = Entries(qd), at_qdd = Entries(qdd);
  const auto rows = Entries(J);
  SumPaths(
      {at_q.data(), at_qd.data(), at_qdd.data()}, 1, rows.data(), nullptr, n,
      [&](auto& chain, auto& geometry, auto& motion, auto* to, auto*,
          long apart) {
        kernels_->torque_geometry_of_one(chain, geometry, motion, 0, to, apart);
      });
  return J;
}

void GeometryJacobian::Momentum(const VectorXd& q, const VectorXd& qd,
                                MatrixXd* P, MatrixXd* D) const {
  const int n = num_joints();
  CHECK(q.size() == n && qd.size() == n);
  P->resize(n, size());
  D->resize(n, size());
  const auto at_q = Entries(q), at_qd = Entries(qd);
  const auto rows = Entries(*P), more_rows = Entries(*D);
  SumPaths({at_q.data(), at_qd.data(), nullptr}, 1, rows.data(),
           more_rows.data(), n,
           [&](auto& chain, auto& geometry, auto& motion, auto* to, auto* more,
               long apart) {
             kernels_->momentum_geometry_of_one(chain, geometry, motion, 0, to,
                                                more, apart);
           });
}

}  // namespace armcal
