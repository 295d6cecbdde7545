#include "problems/link_functions.h"

#include <numeric>

namespace armcal {

using Eigen::VectorXd;

namespace {

std::vector<int> AllInertials(int num_links) {
  std::vector<int> all(10 * num_links);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

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
    : LinkFunctions(robot, terms, geometry, refined,
                    AllInertials(robot.num_joints())) {}

LinkFunctions::LinkFunctions(const Robot& robot,
                             const std::vector<JointTermColumn>& terms,
                             const ArmGeometry& geometry,
                             const std::vector<int>& refined,
                             const std::vector<int>& inertial)
    // Columns are ordered links, terms, geometry. A joint carries only the
    // links beyond it, so its row has the last row_size(i) of the links'
    // columns (U is block upper triangular), its own terms, and all of the
    // geometry: an angle before the joint tilts gravity, and lengths on either
    // side change how the links beyond it are accelerated.
    : terms_(terms),
      regressor_(geometry.ApplyTo(robot), inertial),
      geometry_(robot, geometry, refined),
      coulomb_(terms),
      columns_(
          static_cast<int>(inertial.size() + terms.size() + refined.size())) {
  const auto links = static_cast<int>(inertial.size());
  for (int i = 0; i < robot.num_joints(); ++i) {
    std::vector<int>& used = row_columns_.emplace_back();
    for (int c = links - regressor_.row_size(i); c < links; ++c) {
      used.push_back(c);
    }
    for (size_t t = 0; t < terms.size(); ++t) {
      if (terms[t].joint == i) used.push_back(links + static_cast<int>(t));
    }
    for (int c = columns_ - geometry_.size(); c < columns_; ++c) {
      used.push_back(c);
    }
  }
}

void LinkFunctions::Enter(const Trajectory& trajectory) {
  trajectory_ = &trajectory;
  states_ = coulomb_.FollowTorque(trajectory);
}

bool LinkFunctions::Useless(int sample) const {
  return coulomb_.size() > 0 && trajectory_->standstill[sample];
}

MotionColumns LinkFunctions::Motion(int first) const {
  return MotionColumns(trajectory_->q, trajectory_->qd, trajectory_->qdd,
                       states_, first);
}

// Calls `write` for each joint term with the place of its column in the joint's
// row, behind the links' columns and in order, and with the states of Coulomb
// friction (c of docs/theory.md, 1) where it is such a term.
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

// P and D of tau = (d/dt P - D) X. Terms of a joint act on its own row alone.
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
