#include "model/dynamics/joint_law_torques.h"

#include <algorithm>

#include "model/signals/stiff_step.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Steps per sample of the states of joint laws.
constexpr int kStepsOfLaw = 2;

// What laws see between sample k and the next, as stages of steps ask for it.
class InstantsBetween {
 public:
  explicit InstantsBetween(const MotionTrack& track) : track_(track) {}

  void Begin(int k) {
    k_ = k;
    count_ = 0;
  }
  const ArmInstant& At(double share) {
    for (int i = 0; i < count_; ++i) {
      if (shares_[i] == share) return instants_[i];
    }
    const int i = std::min(count_, kMost - 1);
    count_ = i + 1;
    shares_[i] = share;
    track_.Between(k_, share, &instants_[i]);
    return instants_[i];
  }
  double step() const { return track_.t[k_ + 1] - track_.t[k_]; }

 private:
  static constexpr int kMost = 2 * kStepsOfLaw;  // stages

  const MotionTrack& track_;
  int k_ = 0, count_ = 0;
  double shares_[kMost];
  ArmInstant instants_[kMost];
};

// A law on its way along the motion. `Size`: of its state, or Eigen::Dynamic.
template <int Size>
class LawRun {
 public:
  explicit LawRun(const JointLaw& law)
      : law_(&law),
        x_(law.initial_state),
        unused_(x_),
        step_(static_cast<int>(x_.size())) {}

  double TorqueAt(const ArmInstant& instant) {
    return law_->torque(instant, x_.data(), unused_.data());
  }
  void Advance(InstantsBetween* between) {
    const double step = between->step();
    const ArmInstant* instant = nullptr;
    double at = -1;  // the share that `instant` is of
    const auto rate = [&](double share, const double* state, double* dx) {
      if (share != at) instant = &between->At(share);
      at = share;
      law_->torque(*instant, state, dx);
      for (Eigen::Index i = 0; i < x_.size(); ++i) dx[i] *= step;
    };
    const double share = 1. / kStepsOfLaw;
    for (int i = 0; i < kStepsOfLaw; ++i) {
      step_.Advance(rate, i * share, share, &x_);
    }
  }

 private:
  const JointLaw* law_;
  VectorXd x_, unused_;
  StiffStepOf<Size> step_;
};

// Of laws, copies of one another among them (JointLaw::copy_of), the first of
// each kind, and which of those each is.
struct Originals {
  explicit Originals(const std::vector<const JointLaw*>& laws) {
    for (const JointLaw* law : laws) {
      const auto known =
          std::find_if(all.begin(), all.end(), [&](const JointLaw* other) {
            return law->copy_of >= 0 && law->copy_of == other->copy_of;
          });
      which.push_back(known - all.begin());
      if (known == all.end()) all.push_back(law);
    }
  }

  std::vector<const JointLaw*> all;
  std::vector<long> which;
};

// All laws go along the motion in one sweep, since the instants between
// samples, which states are integrated over, cost more than most laws. Laws of
// one state, which are the most, have a step of fixed size.
std::vector<VectorXd> Follow(const std::vector<const JointLaw*>& laws,
                             const MotionTrack& track) {
  std::vector<VectorXd> torques;
  if (laws.empty()) return torques;
  std::vector<LawRun<1>> with_state;
  std::vector<LawRun<Eigen::Dynamic>> with_states;
  for (const JointLaw* law : laws) {
    torques.emplace_back(track.size());
    if (law->initial_state.size() == 1) with_state.emplace_back(*law);
    if (law->initial_state.size() > 1) with_states.emplace_back(*law);
  }
  InstantsBetween between(track);
  ArmInstant instant;
  for (int k = 0; k < track.size(); ++k) {
    track.At(k, &instant);
    size_t one = 0, more = 0;
    for (size_t i = 0; i < laws.size(); ++i) {
      const auto states = laws[i]->initial_state.size();
      torques[i][k] = states == 0   ? laws[i]->torque(instant, nullptr, nullptr)
                      : states == 1 ? with_state[one++].TorqueAt(instant)
                                    : with_states[more++].TorqueAt(instant);
    }
    if (k + 1 == track.size()) break;
    between.Begin(k);
    for (auto& run : with_state) run.Advance(&between);
    for (auto& run : with_states) run.Advance(&between);
  }
  return torques;
}

}  // namespace

std::vector<VectorXd> JointLawTorques(const std::vector<const JointLaw*>& laws,
                                      const MotionTrack& track) {
  const Originals originals(laws);
  const std::vector<VectorXd> torques = Follow(originals.all, track);
  std::vector<VectorXd> of_each;
  for (const long k : originals.which) of_each.push_back(torques[k]);
  return of_each;
}

}  // namespace armcal
