#pragma once

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

struct SelectionOptions {
  int most_effects = static_cast<int>(Limits().most_effects);
  // An effect's score, delta chi^2 - k ln N - 2 ln(shapes tried), has to
  // exceed this.
  double threshold = Limits().score;
  // A further effect has to explain this share of the strongest one's delta
  // chi^2: on a joint that has one already (whose form is never quite right),
  // elsewhere.
  double same_joint_share = Limits().same_joint_share;
  double other_joint_share = Limits().other_joint_share;
  double inflation = 1;  // of noise variance: delta chi^2 is divided by it
  bool events = true;    // whether something may have happened once
};

}  // namespace armcal
