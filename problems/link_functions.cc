#include "problems/link_functions.h"

namespace armcal {

using Eigen::VectorXd;

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
      geometry_(robot, geometry, refined),
      coulomb_(terms),
      columns_(10 * robot.num_joints() +
               static_cast<int>(terms.size() + refined.size())) {
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

MotionColumns LinkFunctions::Motion(int first) const {
  return MotionColumns(trajectory_->q, trajectory_->qd, trajectory_->qdd,
                       states_, first);
}

// The terms come behind the links' columns, in order.
template <class Write>
void LinkFunctions::ForEachTerm(int first, long stride,
                                const Write& write) const {
  const int n = regressor_.num_joints();
  std::vector<long> next(n);
  for (int i = 0; i < n; ++i) next[i] = regressor_.row_size(i) * stride;
  int coulomb = 0;
  for (const JointTermColumn& term : terms_) {
    const double* state = nullptr;
    if (term.term == JointTerm::kCoulomb) {
      state = states_.col(coulomb++).data() + first;
    }
    write(term, next[term.joint], state);
    next[term.joint] += stride;
  }
}

std::vector<double*> LinkFunctions::Geometry(double* const* rows,
                                             long stride) const {
  std::vector<double*> geometry;
  for (size_t i = 0; i < row_columns_.size(); ++i) {
    const auto size = static_cast<long>(row_columns_[i].size());
    geometry.push_back(rows[i] + (size - geometry_.size()) * stride);
  }
  return geometry;
}

void LinkFunctions::Momentum(int first, int count, double* const* P,
                             double* const* D, long stride) const {
  const MotionColumns motion = Motion(first);
  regressor_.Momentum(motion, count, P, D, stride);
  ForEachTerm(first, stride,
              [&](const JointTermColumn& term, long at, const double* state) {
                const int j = term.joint;
                for (int s = 0; s < count; ++s) {
                  const double qd = motion.qd[j][s];
                  P[j][at + s] = term.P(qd);
                  D[j][at + s] = term.D(qd, state == nullptr ? 0 : state[s]);
                }
              });
  geometry_.Momentum(motion, count, Geometry(P, stride).data(),
                     Geometry(D, stride).data(), stride);
}

void LinkFunctions::Differential(int first, int count, double* const* U,
                                 long stride) const {
  const MotionColumns motion = Motion(first);
  regressor_.Differential(motion, count, U, stride);
  ForEachTerm(first, stride,
              [&](const JointTermColumn& term, long at, const double* state) {
                const int j = term.joint;
                for (int s = 0; s < count; ++s) {
                  U[j][at + s] = term.Torque(motion.qd[j][s], motion.qdd[j][s],
                                             state == nullptr ? 0 : state[s]);
                }
              });
  geometry_.Torque(motion, count, Geometry(U, stride).data(), stride);
}

}  // namespace armcal
