#pragma once

#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/selection_options.h"

namespace armcal {

// The form of an effect is never quite right: what that leaves looks like other
// effects, on its joint most of all. One more effect has to be larger.

// By which chi^2 falls with these together, against the baseline alone.
double TotalDeltaChi2(const GapScreen& screen,
                      const std::vector<GapCandidate>& candidates,
                      const std::vector<int>& chosen);
// By which chi^2 rises when each is left out.
std::vector<double> DeltaChi2OfEach(const GapScreen& screen,
                                    const std::vector<GapCandidate>& candidates,
                                    const std::vector<int>& chosen);

// What one more effect explains.
struct GainOfMore {
  const std::vector<int>&fewer, &more;
  double gain, before;  // of chi^2, by `more` given `fewer`, by those before
};

// Whether that is more than an error in the form of the strongest would be,
// whose joint is its own.
bool IsLarge(const GapScreen& screen,
             const std::vector<GapCandidate>& candidates,
             const SelectionOptions& options, int strongest, int other,
             const GainOfMore& gain);

// Whether each of `more` is large enough compared to the strongest of them, and
// those that are new given what `fewer` explain.
bool AreLarge(const GapScreen& screen,
              const std::vector<GapCandidate>& candidates,
              const SelectionOptions& options, const std::vector<int>& fewer,
              const std::vector<int>& more);

}  // namespace armcal
