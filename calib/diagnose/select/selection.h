#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/delta_chi2.h"
#include "calib/diagnose/select/selection_options.h"

namespace armcal {

// A set of candidates (indices) that together explain the residual.
struct Selection {
  std::vector<int> chosen;         // in the order of delta_chi2, largest first
  std::vector<double> delta_chi2;  // by which chi^2 rises without each
  std::vector<double> scores;      // delta_chi2 less the penalties
};

// Scores of every candidate as a replacement of chosen[k] (-1: in addition to
// all).
Eigen::VectorXd ScoresGiven(const GapScreen& screen,
                            const std::vector<GapCandidate>& candidates,
                            const SelectionOptions& options,
                            const std::vector<int>& chosen, int k);
// The same in addition to `others`, for one gradient after the other.
class ScoresInAddition {
 public:
  // Keeps `screen` and `candidates`.
  ScoresInAddition(const GapScreen& screen,
                   const std::vector<GapCandidate>& candidates,
                   const SelectionOptions& options,
                   const std::vector<int>& others);
  // Were `g` the screen's.
  Eigen::VectorXd operator()(const Eigen::VectorXd& g) const;

 private:
  DeltaChi2Given delta_chi2_;
  double inflation_;
  std::vector<double> penalty_;  // infinite where it is out of the question
};

// The best of these scores above 0, one of each effect at each place, at most
// `count`.
std::vector<int> BestPlaces(const std::vector<GapCandidate>& candidates,
                            Eigen::VectorXd scores, int count);

// Forward, by several sets at a time; at each size the best set has its members
// swapped for better ones, and must need them all.
Selection SelectEffects(const GapScreen& screen,
                        const std::vector<GapCandidate>& candidates,
                        const SelectionOptions& options);

// Delta chi^2 and scores of these.
Selection DescribeSelection(const GapScreen& screen,
                            const std::vector<GapCandidate>& candidates,
                            const SelectionOptions& options,
                            const std::vector<int>& chosen);

// The penalty of a candidate's k parameters (as BIC has it, Schwarz 1978) and
// of the M shapes it was chosen from: k ln N + 2 ln M, and more near zero
// velocity.
double Penalty(const GapScreen& screen, const GapCandidate& candidate);

// The same where `varied` parameters, linear ones included, were fitted instead
// of chosen from shapes.
double RefinedPenalty(const GapScreen& screen, const GapCandidate& candidate,
                      int varied);

}  // namespace armcal
