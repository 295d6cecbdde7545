#include "problems/link_functions.h"

#include "problems/joint_columns.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = 1e-5;  // m or rad

}  // namespace

VectorXd StackInertials(const Robot& robot) {
  VectorXd V(10 * robot.num_joints());
  for (int i = 0; i < robot.num_joints(); ++i) {
    V.segment<10>(10 * i) = robot.links[i].inertial.ToVector();
  }
  return V;
}

LinkFunctions::LinkFunctions(const Robot& robot,
                             const std::vector<JointTermColumn>& terms,
                             const ArmGeometry& geometry,
                             const std::vector<int>& refined)
    : terms_(terms),
      regressor_(geometry.ApplyTo(robot)),
      inertia_(StackInertials(robot)),
      coulomb_(terms),
      columns_(10 * robot.num_joints() +
               static_cast<int>(terms.size() + refined.size())) {
  for (const int k : refined) {
    ArmGeometry changed = geometry;
    VectorXd values = geometry.Values();
    values[k] += kStep;
    changed.SetValues(values);
    const Robot plus = changed.ApplyTo(robot);
    values[k] -= 2 * kStep;
    changed.SetValues(values);
    perturbed_.push_back(
        {BatchRegressor(plus), BatchRegressor(changed.ApplyTo(robot))});
  }
  const int n = robot.num_joints();
  for (int i = 0; i < n; ++i) {
    std::vector<int>& used = row_columns_.emplace_back();
    for (int c = 10 * i; c < 10 * n; ++c) used.push_back(c);
    for (size_t t = 0; t < terms.size(); ++t) {
      if (terms[t].joint == i) used.push_back(10 * n + static_cast<int>(t));
    }
    for (size_t g = 0; g < refined.size(); ++g) {
      used.push_back(10 * n + static_cast<int>(terms.size() + g));
    }
  }
}

void LinkFunctions::Enter(const Trajectory& trajectory) {
  trajectory_ = &trajectory;
  states_ = coulomb_.Follow(trajectory);
}

bool LinkFunctions::Useless(int sample) const {
  return coulomb_.size() > 0 && trajectory_->standstill[sample];
}

void LinkFunctions::Momentum(int first, int count, double* const* P,
                             double* const* D, long stride) const {
  regressor_.Momentum(Motion(first), count, P, D, stride);
  AddTerms(first, count, P, D, stride);
  AddGeometry(first, count, P, D, stride);
}

MotionColumns LinkFunctions::Motion(int first) const {
  return MotionColumns(trajectory_->q, trajectory_->qd, trajectory_->qdd,
                       states_, first);
}

void LinkFunctions::AddTerms(int first, int count, double* const* P,
                             double* const* D, long stride) const {
  const int n = regressor_.num_joints();
  std::vector<long> next(n);
  for (int i = 0; i < n; ++i) next[i] = regressor_.row_size(i) * stride;
  int coulomb = 0;
  for (const JointTermColumn& term : terms_) {
    const int j = term.joint;
    const int state = term.term == JointTerm::kCoulomb ? coulomb++ : -1;
    for (int s = 0; s < count; ++s) {
      const double c = state < 0 ? 0 : states_(first + s, state);
      const double qd = trajectory_->qd(first + s, j);
      P[j][next[j] + s] = term.P(qd);
      D[j][next[j] + s] = term.D(qd, c);
    }
    next[j] += stride;
  }
}

// Central differences of P and D times the inertia.
void LinkFunctions::AddGeometry(int first, int count, double* const* P,
                                double* const* D, long stride) const {
  if (perturbed_.empty()) return;
  using Column = Eigen::Map<VectorXd>;
  using Columns = Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>>;
  const int n = regressor_.num_joints();
  const auto& last = row_columns_;
  std::vector<int> sizes;
  for (int i = 0; i < n; ++i) sizes.push_back(regressor_.row_size(i));
  JointColumns P_of, D_of;
  P_of.Resize(sizes, count);
  D_of.Resize(sizes, count);
  const long geometry = static_cast<long>(perturbed_.size());
  for (long g = 0; g < geometry; ++g) {
    for (const double sign : {1.0, -1.0}) {
      const BatchRegressor& arm =
          sign > 0 ? perturbed_[g].plus : perturbed_[g].minus;
      arm.Momentum(Motion(first), count, P_of.data(), D_of.data(),
                   P_of.stride());
      for (int i = 0; i < n; ++i) {
        const long at =
            (static_cast<long>(last[i].size()) - geometry + g) * stride;
        const auto V = sign / (2 * kStep) * inertia_.tail(sizes[i]);
        for (const auto& [of, to] : {std::make_pair(&P_of, P[i] + at),
                                     std::make_pair(&D_of, D[i] + at)}) {
          const Columns columns(of->column(i, 0), count, sizes[i],
                                Eigen::OuterStride<>(of->stride()));
          if (sign > 0) Column(to, count).setZero();
          Column(to, count) += columns * V;
        }
      }
    }
  }
}

}  // namespace armcal
