#include "model/dynamics/motion_tangent.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

long WholeLines(long numbers) { return (numbers + 7) / 8 * 8; }

double LogCosh(double u) {
  const double size = std::abs(u);
  return size + std::log1p(std::exp(-2 * size)) - M_LN2;
}

// Means of c = tanh(v / width) and of its derivatives by v and by the width
// where v goes from v0 to v1 in a straight line.
struct CoulombMeans {
  CoulombMeans(double v0, double v1, double width) {
    const double u0 = v0 / width, u1 = v1 / width, du = u1 - u0;
    const double c0 = std::tanh(u0), c1 = std::tanh(u1);
    if (std::abs(du) < 1e-4) {  // differences would lose digits
      c = (c0 + c1) / 2;
      by_velocity = (1 - c * c) / width;
      by_width = -by_velocity * (u0 + u1) / 2;
      return;
    }
    const double area = (LogCosh(u1) - LogCosh(u0)) / du;
    c = area;
    by_velocity = (c1 - c0) / (du * width);
    by_width = (area - (u1 * c1 - u0 * c0) / du) / width;
  }
  double c, by_velocity, by_width;
};

}  // namespace

// Of periods, a row each.
struct MotionTangent::Means {
  Means(const MatrixXd& q_at, const MatrixXd& qd_at, long first, long periods,
        double length)
      : count(periods),
        qd0(qd_at.middleRows(first, periods)),
        qd1(qd_at.middleRows(first + 1, periods)) {
    const auto q0 = q_at.middleRows(first, periods);
    const auto q1 = q_at.middleRows(first + 1, periods);
    // Of the cubic through both ends.
    q = (q0 + q1) / 2 + length / 12 * (qd0 - qd1);
    qd = (q1 - q0) / length;
    qdd = (qd1 - qd0) / length;
  }
  long count;
  MatrixXd q, qd, qdd, qd0, qd1;
};

MotionTangent::MotionTangent(const RolloutArm& arm,
                             const TangentParameters& parameters,
                             const simd::Kernels& kernels)
    : arm_(arm),
      parameters_(parameters),
      kernels_(&kernels),
      inertia_(arm.robot, kernels),
      torque_(arm.robot, kernels),
      by_position_(arm.robot, JointTwists(arm.robot), kernels),
      direct_(WholeLines(3 * num_joints() * num_joints())),
      direct_columns_(WholeLines(num_parameters())),
      size_(direct_ + direct_columns_ * num_joints()) {
  if (!parameters.inertials.empty()) {
    regressor_.emplace(arm.robot, parameters.inertials, kernels);
  }
  arm_.transitions.resize(num_joints());
}

void MotionTangent::Linearise(const MatrixXd& q, const MatrixXd& qd, long first,
                              long periods, double length) {
  CHECK_LE(first + periods, q.rows() - 1);
  length_ = length;
  if (periods > capacity_) {
    capacity_ = periods;
    records_ = AlignedNumbers(periods * size_);
    const long n = num_joints();
    const long most = std::max<long>(
        2 * n * n, static_cast<long>(parameters_.inertials.size()) * n);
    columns_ = AlignedNumbers(WholeLines(periods) * most);
  }
  const Means means(q, qd, first, periods, length);
  SetInertia(means);
  SetByState(means);
  if (regressor_) SetInertials(means);
  SetTerms(means);
}

void MotionTangent::SetInertia(const Means& means) {
  const int n = num_joints();
  MatrixXd M;
  inertia_.MassMatrix(means.q, &M);
  for (long s = 0; s < means.count; ++s) {
    double* to = Record(s);
    for (int k = 0; k < n * n; ++k) to[k] = M(s, k);
    for (int j = 0; j < n; ++j) {
      to[n * j + j] += arm_.robot.links[j].joint.armature;
    }
  }
}

// The torque is a quadratic form of the velocity, whose derivative is half the
// difference over any two, exactly.
void MotionTangent::SetByState(const Means& means) {
  const int n = num_joints();
  const long count = means.count, stride = WholeLines(count);
  MotionColumns at(means.q, means.qd, means.qdd, {});
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
  VectorXd shifted(count);
  for (int k = 0; k < n; ++k) {
    at.qd[k] = shifted.data();
    shifted = means.qd.col(k).array() - 1;
    torque_.Torque(at, count, below.data());
    shifted.array() += 2;
    torque_.Torque(at, count, above.data());
    at.qd[k] = means.qd.col(k).data();
    for (int i = 0; i < n; ++i) {
      for (long s = 0; s < count; ++s) {
        Record(s)[n * (2 * n + i) + k] = (above[i][s] - below[i][s]) / 2;
      }
    }
  }
}

// The torque is linear in the inertial parameters: its derivatives by them are
// the regressor's columns at the period's mean motion.
void MotionTangent::SetInertials(const Means& means) {
  const int n = num_joints();
  const long stride = WholeLines(means.count);
  const auto& inertials = parameters_.inertials;
  const int size = static_cast<int>(inertials.size());
  std::vector<double*> out;
  std::vector<int> begin;  // joint i's columns: of links i to the last
  double* next = columns_.data();
  for (int i = 0; i < n; ++i) {
    out.push_back(next);
    begin.push_back(static_cast<int>(
        std::lower_bound(inertials.begin(), inertials.end(), 10 * i) -
        inertials.begin()));
    next += (size - begin.back()) * stride;
  }
  regressor_->Differential({means.q, means.qd, means.qdd, {}}, means.count,
                           out.data(), stride);
  for (long s = 0; s < means.count; ++s) {
    for (int i = 0; i < n; ++i) {
      double* row = Record(s) + direct_ + i * direct_columns_;
      for (int k = begin[i]; k < size; ++k) {
        row[k] = out[i][(k - begin[i]) * stride + s];
      }
    }
  }
}

// Adds what joint terms change: friction's slope by velocity, and the torque by
// each term that is asked for. The slope also joins the inertia, times half the
// period, as the velocity at the end is part of the mean that friction acts by.
void MotionTangent::SetTerms(const Means& means) {
  const int n = num_joints();
  const int inertials = static_cast<int>(parameters_.inertials.size());
  for (int j = 0; j < n; ++j) {
    const Joint& joint = arm_.robot.links[j].joint;
    const double width = arm_.transitions[j].width;
    for (long s = 0; s < means.count; ++s) {
      const CoulombMeans friction(means.qd0(s, j), means.qd1(s, j), width);
      double* const record = Record(s);
      const double slope = joint.viscous + joint.coulomb * friction.by_velocity;
      record[n * j + j] += length_ / 2 * slope;
      record[n * (2 * n + j) + j] += slope;
      double* const row = record + direct_ + j * direct_columns_ + inertials;
      for (size_t k = 0; k < parameters_.terms.size(); ++k) {
        const TangentParameters::Term& term = parameters_.terms[k];
        if (term.joint != j) continue;
        row[k] = term.term ? JointTermColumn{j, *term.term, {}}.Torque(
                                 means.qd(s, j), means.qdd(s, j), friction.c)
                           : joint.coulomb * friction.by_width;
      }
    }
  }
}

void MotionTangent::Advance(long period, const TangentRows& torque,
                            bool by_parameters, TangentRows* state) const {
  const int n = num_joints();
  const double* record = Record(period);
  simd::TangentStep at{};
  at.num_joints = n;
  at.length = length_;
  at.inertia = record;
  at.by_q = record + n * n;
  at.by_qd = record + 2 * n * n;
  at.direct = record + direct_;
  at.stride = state->stride();
  at.columns = static_cast<int>(at.stride);
  at.direct_columns = by_parameters ? static_cast<int>(direct_columns_) : 0;
  CHECK_EQ(torque.stride(), at.stride);
  at.torque = torque.row(0);
  kernels_->advance_tangents(at, state->row(0));
}

}  // namespace armcal
