#pragma once

#include <vector>

#include "tests/blind/effect_size.h"
#include "tests/blind/equivalents.h"

namespace armcal {

// From this |cos| on two effects are equivalent.
inline constexpr double kAlike = .95;

// Every kind of effect on every joint that can show it, in its usual size and
// form.
std::vector<ChosenEffect> EveryEffect(const BlindCase& blind);

// What is left of effects' torques along the case's training log, whitened,
// after the model has been fitted to each: as for EffectSize. An effect with
// several linear parameters (a load's mass and centre) can be any sum of its
// torques.
class EffectSignals {
 public:
  explicit EffectSignals(const BlindCase& blind) : sizer_(blind) {}

  // Made larger or smaller where its size is too small to see or more than the
  // arm follows. False where there is nothing to compare then.
  bool Add(const ChosenEffect& effect);
  // Of effects with |cos| >= kAlike between one and the nearest sum of the
  // other's.
  std::vector<Equivalents::Pair> Alike() const;

 private:
  static constexpr double kLeast = .01;  // ENR
  struct Signal {
    NamedEffect placed;
    // Whitened, a column for each of its torques, the usual one first.
    Eigen::MatrixXd torques, left;
  };
  static double Cosine(const Signal& one, const Signal& family);

  EffectSizer sizer_;
  std::vector<Signal> signals_;
};

}  // namespace armcal
