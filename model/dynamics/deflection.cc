#include "model/dynamics/deflection.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "model/dynamics/flanked_spring.h"
#include "model/dynamics/motion_track.h"
#include "model/signals/stiff_step.h"
#include "model/simd/kernels.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// A step turns the phase of the fastest oscillation by half a radian at most:
// beyond that the method damps.
constexpr double kPhasePerStep = .5;
constexpr int kMostSubsteps = 10;  // faster ones no filter lets through
// The link rests on its transmission at first: implicit steps of this length.
constexpr int kDeflectionSteps = 20;
constexpr double kDeflectionStep = 1;  // s

// `Size`: of the state, or Eigen::Dynamic.
template <int Size>
class DeflectionRun {
 public:
  DeflectionRun(const DeflectedJoint& joint, double dt)
      : law_(*joint.transmission),
        joint_(joint),
        dt_(dt),
        step_(2 + static_cast<int>(law_.initial_state.size())),
        x_(2 + law_.initial_state.size()),
        unused_(law_.initial_state.size()) {}

  // Where it begins, and in how many steps per half a sample it moves.
  struct Start {
    double angle, rate;
    int substeps;
  };
  Start Begin() {
    SettleInMotion();
    return {x_[0], x_[1], NumSubsteps()};
  }

  Deflection Run() {
    const int samples = static_cast<int>(joint_.load.size());
    signals_.resize(4, samples);
    signals_ << joint_.load.transpose(), joint_.stiffness.transpose(),
        joint_.damping.transpose(), joint_.inertia.transpose();
    Deflection result = {VectorXd(samples), VectorXd(samples),
                         VectorXd(samples)};
    SettleInMotion();
    const int half = NumSubsteps();
    double before = x_[1];
    for (int k = 0; k < samples; ++k) {
      result.angle[k] = x_[0];
      result.rate[k] = x_[1];
      const double begin = k == 0 ? 0 : .5, end = k + 1 == samples ? 0 : .5;
      if (end > 0) Advance(k, 0, half);
      result.acceleration[k] =
          samples > 1 ? (x_[1] - before) / ((begin + end) * dt_) : 0;
      before = x_[1];
      if (end > 0) Advance(k, half, half);
    }
    return result;
  }

 private:
  void Rate(const Eigen::Vector4d& signal, const double* x, double* dx) {
    const auto [load, stiffness, damping, inertia] =
        std::tie(signal[0], signal[1], signal[2], signal[3]);
    dx[0] = x[1];
    dx[1] = (load - stiffness * x[0] - damping * x[1] -
             law_.torque(x[0], x[1], x + 2, dx + 2)) /
            inertia;
  }

  // At rest under the load of sample k, with the law's own states as given.
  void Settle(int k) {
    const Eigen::Vector4d signal(joint_.load[k], joint_.stiffness[k],
                                 joint_.damping[k], joint_.inertia[k]);
    const auto& start = law_.initial_deflection;
    x_ << (start ? start(signal[0]) : 0), 0, law_.initial_state;
    const auto rate = [&](double, const double* x, double* dx) {
      Rate(signal, x, dx);
      std::fill(dx + 2, dx + x_.size(), 0);
    };
    for (int i = 0; i < kDeflectionSteps; ++i) {
      step_.Advance(rate, 0, kDeflectionStep, &x_);
    }
  }

  // As if it had followed the load for long: otherwise it would ring.
  void SettleInMotion() {
    Settle(std::min<int>(1, joint_.load.size() - 1));
    const double next = x_[0];
    Settle(0);
    x_[1] = (next - x_[0]) / dt_;
  }

  // Per half a sample.
  int NumSubsteps() {
    const double dx = 1e-7;
    const double slope =
        (law_.torque(x_[0] + dx, 0, &x_[0] + 2, unused_.data()) -
         law_.torque(x_[0], 0, &x_[0] + 2, unused_.data())) /
        dx;
    const double stiffness = std::max({slope, law_.stiffest, 0.});
    const double omega = std::sqrt(stiffness / joint_.inertia.minCoeff());
    return static_cast<int>(std::clamp(std::ceil(omega * dt_ / kPhasePerStep),
                                       1., 0. + kMostSubsteps));
  }

  // Substeps begin .. begin + half - 1 of 2 half from sample k on.
  void Advance(int k, int begin, int half) {
    double at = -1;  // the share that signal_ is of
    const auto rate = [&](double share, const double* x, double* dx) {
      if (share != at) InterpolateColumns(signals_, k, share, &signal_);
      at = share;
      Rate(signal_, x, dx);
      for (Eigen::Index i = 0; i < x_.size(); ++i) dx[i] *= dt_;
    };
    const double h = .5 / half;
    for (int i = begin; i < begin + half; ++i)
      step_.Advance(rate, i * h, h, &x_);
  }

  const Transmission& law_;
  const DeflectedJoint& joint_;
  Eigen::MatrixXd signals_;  // load and its slopes, samples in columns
  double dt_;
  StiffStepOf<Size> step_;
  VectorXd x_, unused_, signal_;
};

Deflection Follow(const DeflectedJoint& joint, double dt) {
  if (joint.transmission->initial_state.size() > 0) {
    return DeflectionRun<Eigen::Dynamic>(joint, dt).Run();
  }
  return DeflectionRun<2>(joint, dt).Run();
}

// What the kernel has to know of a joint with flanks: its law's numbers, the
// signals, where it starts and in how many steps, and where the deflection goes
// to.
simd::DeflectedLink LinkOf(const DeflectedJoint& joint,
                           const FlankedSpring& spring, double dt,
                           Deflection* to) {
  CHECK(spring.gap == 0 || spring.stiffening == 0);
  const auto samples = joint.load.size();
  *to = {VectorXd(samples), VectorXd(samples), VectorXd(samples)};
  const auto start = DeflectionRun<2>(joint, dt).Begin();
  return {spring.gap,
          spring.stiffness,
          spring.damping,
          spring.stiffening,
          {joint.load.data(), joint.stiffness.data(), joint.damping.data(),
           joint.inertia.data()},
          start.angle,
          start.rate,
          start.substeps,
          to->angle.data(),
          to->rate.data(),
          to->acceleration.data()};
}

}  // namespace

std::vector<Deflection> FollowDeflections(
    const std::vector<DeflectedJoint>& joints, double dt) {
  std::vector<Deflection> all(joints.size());
  std::vector<simd::DeflectedLink> links;
  for (size_t i = 0; i < joints.size(); ++i) {
    CHECK_EQ(joints[i].load.size(), joints[0].load.size());
    const auto* spring = joints[i].transmission->torque.target<FlankedSpring>();
    if (spring == nullptr) {
      all[i] = Follow(joints[i], dt);
    } else {
      links.push_back(LinkOf(joints[i], *spring, dt, &all[i]));
    }
  }
  std::vector<const simd::DeflectedLink*> order;
  for (const simd::DeflectedLink& link : links) order.push_back(&link);
  // A lane takes as long as the one with most steps.
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) {
                     return std::make_pair(a->kind(), a->substeps) <
                            std::make_pair(b->kind(), b->substeps);
                   });
  if (order.empty()) return all;
  simd::BestKernels().deflections(order.data(), static_cast<int>(order.size()),
                                  joints[0].load.size(), dt);
  return all;
}

}  // namespace armcal
