#pragma once

#include <string>
#include <vector>

#include "calib/gap_candidates.h"
#include "calib/gap_drop.h"
#include "calib/gap_screen.h"

namespace armcal {

struct SelectionOptions {
  int most_effects = 3;
  // An effect's score, drop of chi^2 - k ln N - 2 ln(shapes tried), has to
  // exceed this.
  double threshold = 12;
  // A further effect has to explain this share of the strongest one's drop: on
  // a joint that has one already (whose form is never quite right), elsewhere.
  double same_joint_share = 0.03;
  double other_joint_share = 0.004;
  double inflation = 1;  // of noise variance: drops are divided by it
  bool events = true;    // whether something may have happened once
};

// A set of candidates (indices) that together explain the residual.
struct Selection {
  std::vector<int> chosen;     // in the order of their drops, strongest first
  std::vector<double> drops;   // of chi^2 when each is left out
  std::vector<double> scores;  // of these drops
};

// Scores of every candidate as a replacement of chosen[k] (-1: in addition to
// all).
Eigen::VectorXd ScoresBeside(const GapScreen& screen,
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
  DropsBeside drops_;
  double inflation_;
  std::vector<double> price_;  // infinite where it is out of the question
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

// Drops and scores of these.
Selection DescribeSelection(const GapScreen& screen,
                            const std::vector<GapCandidate>& candidates,
                            const SelectionOptions& options,
                            const std::vector<int>& chosen);

// What has to be paid for a candidate's parameters and the shapes it was chosen
// from: k ln N + 2 ln M, and more near zero velocity.
double Price(const GapScreen& screen, const GapCandidate& candidate);

// The same where `varied` parameters, linear ones included, were fitted instead
// of chosen from shapes.
double RefinedPrice(const GapScreen& screen, const GapCandidate& candidate,
                    int varied);

// All but chosen[k]; all where k is -1.
std::vector<int> Without(std::vector<int> chosen, int k);

// Columns of several candidates.
std::vector<int> ColumnsOf(const std::vector<GapCandidate>& candidates,
                           const std::vector<int>& chosen);

}  // namespace armcal
