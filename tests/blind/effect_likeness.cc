#include "tests/blind/effect_likeness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/blind/size_parameter.h"
#include "tests/blind/size_search.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<ChosenEffect> EveryEffect(const BlindCase& blind) {
  const EffectContext context = TypicalContext(blind.robot, 0);
  SimulatedRobot plant;
  plant.robot = blind.robot;
  std::vector<ChosenEffect> effects;
  for (const HiddenEffect& kind : HiddenEffects()) {
    const Eigen::VectorXd parameters = UsualParameters(kind);
    const bool whole = kind.scope == HiddenEffect::Scope::kRobot;
    for (int j = whole ? -1 : 0; j < (whole ? 0 : blind.robot.num_joints());
         ++j) {
      if (WhyNotApplicable(kind, plant, j, parameters, context).empty()) {
        effects.push_back({&kind, j, parameters});
      }
    }
  }
  return effects;
}

bool EffectSignals::Add(const ChosenEffect& effect) {
  const SizeAim aim = {1, .3, std::numeric_limits<double>::infinity()};
  const auto found = FindSize(effect, aim, [this](const ChosenEffect& e) {
    return sizer_.SizeOfLast({e});
  });
  if (!found || found->size.enr < kLeast) return false;
  std::vector<ChosenEffect> family = {found->effect};
  for (int k : SizeParameterOf(*effect.kind).linear) {
    const EffectParameter& parameter = effect.kind->parameters[k];
    family.push_back(found->effect);
    family.back().parameters[k] += .1 * (parameter.high - parameter.low);
  }
  const CaseNoise& noise = sizer_.noise();
  const MatrixXd& none = *sizer_.training()->Residual({});
  Signal signal = {{effect.kind->name, effect.joint + 1}, {}, {}};
  for (const ChosenEffect& member : family) {
    const MatrixXd* run = sizer_.training()->Residual({member});
    if (!run) continue;  // the arm does not follow with it
    const VectorXd torque = noise.White(*run - none);
    const long k = signal.torques.cols();
    signal.torques.conservativeResize(torque.size(), k + 1);
    signal.left.conservativeResize(torque.size(), k + 1);
    signal.torques.col(k) = torque;
    signal.left.col(k) = noise.absorption().Of(torque).residual;
  }
  signals_.push_back(signal);
  return true;
}

// In the inner product in which what the model absorbs counts nothing.
double EffectSignals::Cosine(const Signal& one, const Signal& family) {
  const MatrixXd gram = family.torques.transpose() * family.left;
  const VectorXd with = family.torques.transpose() * one.left.col(0);
  const double share = with.dot(gram.ldlt().solve(with)) /
                       one.torques.col(0).dot(one.left.col(0));
  return std::sqrt(std::clamp(share, 0.0, 1.0));
}

std::vector<Equivalents::Pair> EffectSignals::Alike() const {
  std::vector<Equivalents::Pair> pairs;
  for (size_t i = 0; i < signals_.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      const Signal &a = signals_[k], &b = signals_[i];
      const double cosine = std::max(Cosine(a, b), Cosine(b, a));
      if (cosine >= kAlike) pairs.push_back({a.placed, b.placed, cosine});
    }
  }
  return pairs;
}

}  // namespace armcal
