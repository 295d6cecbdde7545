#include "model/motion_tangent.h"

#include <glog/logging.h>

#include <cmath>
#include <vector>

namespace armcal {
namespace {

using Eigen::MatrixXd;

constexpr int kStages = StageMotion::kStages;
constexpr int kInertial = 10, kTerms = 4;

long WholeLines(long numbers) { return (numbers + 7) / 8 * 8; }

// d/dqd and d/dwidth of c = tanh(qd / width).
struct CoulombSlopes {
  CoulombSlopes(double c, double qd, double width)
      : by_velocity((1 - c * c) / width), by_width(-by_velocity * qd / width) {}
  double by_velocity, by_width;
};

}  // namespace

MotionTangent::MotionTangent(const RolloutArm& arm,
                             const simd::Kernels& kernels)
    : arm_(arm),
      kernels_(&kernels),
      inertia_(arm.robot, kernels),
      torque_(arm.robot, kernels),
      regressor_(arm.robot, kernels),
      by_position_(arm.robot, JointTwists(arm.robot), kernels),
      direct_(WholeLines(3 * num_joints() * num_joints())),
      direct_columns_(WholeLines(num_parameters())),
      size_(direct_ + direct_columns_ * num_joints()) {
  arm_.transitions.resize(num_joints());
}

void MotionTangent::Linearise(const StageMotion& motion, long steps) {
  const long count = kStages * steps;
  const int n = num_joints();
  CHECK_GE(motion.q.rows(), count);
  if (count > capacity_) {
    capacity_ = count;
    records_ = AlignedNumbers(count * size_);
    columns_ = AlignedNumbers(WholeLines(count) * kInertial * n * (n + 1) / 2);
  }
  SetInertia(motion, count);
  SetByState(motion, count);
  SetDirect(motion, count);
}

void MotionTangent::SetInertia(const StageMotion& motion, long count) {
  const int n = num_joints();
  MatrixXd M;
  inertia_.MassMatrix(motion.q.topRows(count), &M);
  for (long s = 0; s < count; ++s) {
    double* to = Record(s);
    for (int k = 0; k < n * n; ++k) to[k] = M(s, k);
    for (int j = 0; j < n; ++j) {
      to[n * j + j] += arm_.robot.links[j].joint.armature;
    }
  }
}

// The torque is a quadratic form of the velocity, whose derivative is half the
// difference over any two, exactly.
void MotionTangent::SetByState(const StageMotion& motion, long count) {
  const int n = num_joints();
  const long stride = WholeLines(count);
  MotionColumns at(motion.q, motion.qd, motion.qdd, {});
  std::vector<double*> out;
  for (int i = 0; i < n; ++i) {
    out.push_back(columns_.data() + i * n * stride);
  }
  by_position_.Torque(at, count, out.data(), stride);
  for (long s = 0; s < count; ++s) {
    double* to = Record(s) + n * n;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) to[n * i + k] = out[i][k * stride + s];
    }
  }
  std::vector<double*> below, above;
  for (int i = 0; i < n; ++i) {
    below.push_back(columns_.data() + i * stride);
    above.push_back(columns_.data() + (n + i) * stride);
  }
  Eigen::VectorXd shifted(count);
  for (int k = 0; k < n; ++k) {
    at.qd[k] = shifted.data();
    shifted = motion.qd.col(k).head(count).array() - 1;
    torque_.Torque(at, count, below.data());
    shifted.array() += 2;
    torque_.Torque(at, count, above.data());
    at.qd[k] = motion.qd.col(k).data();
    for (int i = 0; i < n; ++i) {
      for (long s = 0; s < count; ++s) {
        Record(s)[n * (2 * n + i) + k] = (above[i][s] - below[i][s]) / 2;
      }
    }
  }
}

void MotionTangent::SetDirect(const StageMotion& motion, long count) {
  const int n = num_joints();
  const long stride = WholeLines(count), D = direct_columns_;
  std::vector<double*> out;
  double* next = columns_.data();
  for (int i = 0; i < n; ++i) {  // joint i's: links i to the last
    out.push_back(next);
    next += kInertial * (n - i) * stride;
  }
  regressor_.Differential({motion.q, motion.qd, motion.qdd, {}}, count,
                          out.data(), stride);
  for (long s = 0; s < count; ++s) {
    for (int i = 0; i < n; ++i) {
      double* row = Record(s) + direct_ + i * D;
      for (int k = kInertial * i; k < kInertial * n; ++k) {
        row[k] = out[i][(k - kInertial * i) * stride + s];
      }
      const Joint& joint = arm_.robot.links[i].joint;
      const CoulombTransition& transition = arm_.transitions[i];
      const double qd = motion.qd(s, i), c = transition.C(qd, 0);
      const CoulombSlopes slopes(c, qd, transition.width);
      double* terms = row + kInertial * n + kTerms * i;
      terms[0] = qd;
      terms[1] = c;
      terms[2] = 1;
      terms[3] = motion.qdd(s, i);
      row[(kInertial + kTerms) * n + i] = joint.coulomb * slopes.by_width;
      Record(s)[n * (2 * n + i) + i] +=
          joint.viscous + joint.coulomb * slopes.by_velocity;
    }
  }
}

void MotionTangent::Advance(long step, double length,
                            const TangentRows* const torque[3],
                            bool by_parameters, TangentRows* state) const {
  const int n = num_joints();
  simd::TangentStep at{};
  at.num_joints = n;
  at.step = length;
  for (int i = 0; i < kStages; ++i) {
    const double* record = Record(kStages * step + i);
    at.stages[i] = {record, record + n * n, record + 2 * n * n,
                    record + direct_};
  }
  at.stride = state->stride();
  at.columns = static_cast<int>(at.stride);
  at.direct_columns = by_parameters ? static_cast<int>(direct_columns_) : 0;
  for (int k = 0; k < 3; ++k) {
    CHECK_EQ(torque[k]->stride(), at.stride);
    at.torque[k] = torque[k]->row(0);
  }
  kernels_->advance_tangents(at, state->row(0));
}

}  // namespace armcal
