#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

// An effect at a place, whatever its shape, and how probable it is that it is
// the one.
struct PlacedEffect {
  const Effect* effect = nullptr;
  int joint = -1;  // from 0; -1: all joints or the whole robot
  double probability = 0;
  double score = 0;
};

// The most probable first, with their probabilities by their scores: P ~
// exp(score / (2 temperature)). Those without a finite score are left out: the
// torque of such an effect has no finite fit.
std::vector<PlacedEffect> ByScore(std::vector<PlacedEffect> all);

// The effects that could stand in place of the k-th that was chosen, the most
// probable first (ByScore). Scores of those whose shapes were fitted are set
// against each other as such, those of the others are of their grids.
std::vector<PlacedEffect> Alternatives(const GapFit& fit, size_t k);

// That something is there without which what was seen has this chance: the odds
// against it are at least -e chance ln(chance) times those before the data
// (Sellke, Bayarri and Berger 2001, Calibration of p values for testing precise
// null hypotheses).
double ProbabilityBeyondChance(double chance, double odds_before);

// The first ones, up to 95 % together.
std::vector<PlacedEffect> CredibleSet(const std::vector<PlacedEffect>& all);

}  // namespace armcal
