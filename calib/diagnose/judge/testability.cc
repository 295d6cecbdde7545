#include "calib/diagnose/judge/testability.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "calib/diagnose/data/thresholds.h"
#include "model/effects/effects.h"

namespace armcal {
namespace {

// Of an effect of usual size, rms over the noise's: of its torque, and of what
// the baseline cannot take for its own.
struct Visibility {
  double alone = 0;
  double size = 0;
};

// The effect-to-noise ratio (ENR): the rms of the effect's torque in units of
// the noise, after the baseline has taken of it what it could, G_cc being its
// squared norm then. Where its joint does not move, the others may feel it.
Visibility VisibilityOf(const GapFit& fit, const GapCandidate& candidate) {
  Visibility visibility;
  const GapScreen& screen = fit.screen();
  // Where its joint does not move, others may feel it.
  const bool own = candidate.joint >= 0 && screen.num_rows(candidate.joint) > 0;
  double rows = 0;
  for (int j = 0; j < screen.num_joints(); ++j) {
    if (!own || candidate.joint == j) rows += screen.num_rows(j);
  }
  for (const int c : candidate.columns) {
    const auto rms = [&](double square) {
      return std::sqrt(std::max(0., square) / std::max(1., rows));
    };
    visibility.alone = std::max(visibility.alone, rms(screen.raw(c)));
    visibility.size = std::max(visibility.size, rms(screen.G()(c, c)));
  }
  return visibility;
}

// What would be seen by itself and is not beside the baseline, that absorbs.
std::string WhyNot(const Visibility& visibility, bool moves) {
  if (visibility.size >= Limits().material) return "";
  if (!moves) return "the joint does not move";
  if (visibility.alone >= Limits().material) {
    return "the model's own parameters would take it for theirs";
  }
  return "one that matters would hide in the noise of this motion";
}

}  // namespace

// For every effect of the catalogue at every joint, why it could neither be
// found nor excluded: the law does not fit the joint (Effect::unfit), the user
// left it out, it was never a candidate (nothing stood out where it would be
// looked for), or even one that matters would be smaller than Limits().material
// of the noise.
std::vector<UntestableEffect> ListUntestable(
    const GapFit& fit, const std::vector<FoundEffect>& found) {
  std::map<std::pair<const Effect*, int>, Visibility> seen;
  for (const GapCandidate& candidate : fit.candidates()) {
    Visibility& best = seen[{candidate.effect, candidate.joint}];
    const Visibility own = VisibilityOf(fit, candidate);
    best.alone = std::max(best.alone, own.alone);
    best.size = std::max(best.size, own.size);
  }
  const Robot& robot = fit.baseline().robot();
  const auto was_found = [&](const Effect& effect, int joint) {
    return std::any_of(found.begin(), found.end(), [&](const FoundEffect& f) {
      return f.effect == &effect && f.joint == joint;
    });
  };
  std::vector<UntestableEffect> untestable;
  for (const Effect& effect : Effects()) {
    const bool whole = effect.scope == Effect::Scope::kRobot;
    for (int j = whole ? -1 : 0; j < (whole ? 0 : robot.num_joints()); ++j) {
      if (was_found(effect, j)) continue;
      const EffectSite site = {&robot, j, &fit.scale()};
      std::string why = effect.unfit ? effect.unfit(site) : "";
      const auto best = seen.find({&effect, j});
      if (fit.IsLeftOut(effect)) {
        why = "it was not to be considered";
      } else if (why.empty()) {
        why = best == seen.end()
                  ? "nothing stands out where it would be looked for"
                  : WhyNot(best->second, whole || fit.rows().num_rows(j) > 0);
      }
      if (why.empty()) continue;
      untestable.push_back(
          {effect.name, whole ? "" : robot.links[j].joint.name, why});
    }
  }
  return untestable;
}

}  // namespace armcal
