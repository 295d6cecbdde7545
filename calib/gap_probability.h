#pragma once

#include <string>
#include <vector>

#include "calib/gap_candidates.h"
#include "calib/gap_screen.h"
#include "calib/gap_selection.h"

namespace armcal {

// An effect at a place, whatever its shape, and how probable it is that it is
// the one.
struct PlacedEffect {
  const Effect* effect = nullptr;
  int joint = -1;  // from 0; -1: all joints or the whole robot
  double probability = 0;
  double score = 0;
};

// The effects that could stand in place of chosen[k], the most probable first,
// as scores over the temperature say: P ~ exp(score / (2 kappa)). Neither
// noise nor the catalogue's limits nor errors of form are as the score assumes:
// kappa = 4 makes up for it on the blind bench's calibration cases (GAP.md B).
std::vector<PlacedEffect> Alternatives(
    const GapScreen& screen, const std::vector<GapCandidate>& candidates,
    const SelectionOptions& options, const std::vector<int>& chosen, int k);

// The first ones, up to 95 % together.
std::vector<PlacedEffect> CredibleSet(const std::vector<PlacedEffect>& all);

}  // namespace armcal
