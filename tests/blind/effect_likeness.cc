#include "tests/blind/effect_likeness.h"

#include <cmath>
#include <limits>

#include "tests/blind/size_search.h"

namespace armcal {

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
  const CaseNoise& noise = sizer_.noise();
  const Eigen::VectorXd torque =
      noise.White(*sizer_.training()->Residual({found->effect}) -
                  *sizer_.training()->Residual({}));
  const Absorption::Left left = noise.absorption().Of(torque);
  signals_.push_back({{effect.kind->name, effect.joint + 1},
                      torque,
                      left.residual,
                      left.squared});
  return true;
}

std::vector<Equivalents::Pair> EffectSignals::Alike() const {
  std::vector<Equivalents::Pair> pairs;
  for (size_t i = 0; i < signals_.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      const Signal &a = signals_[k], &b = signals_[i];
      // The inner product in which what the model absorbs counts nothing.
      const double cosine =
          std::abs(a.torque.dot(b.left)) / std::sqrt(a.squared * b.squared);
      if (cosine >= kAlike) pairs.push_back({a.placed, b.placed, cosine});
    }
  }
  return pairs;
}

}  // namespace armcal
