#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/changes/hypothesis.h"
#include "calib/diagnose/changes/series_fit.h"

namespace armcal {

// A change that the logs tell; of a drift the amounts are what it comes to in
// the last log.
struct FoundChange {
  // Another family that these logs could be of, given the other changes.
  struct Rival {
    int hypothesis;  // its likeliest
    ChangeForm form;
    double probability;
  };
  int hypothesis = 0;
  ChangeCourse course;
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;  // holds the scatter, as well as that is known
  double probability = 0;      // that it is of this family and form
  double any = 0;              // that there is a change at all
  double with_motion = 0;      // that it is none but goes with the motion
  std::vector<int> logs;       // where it may begin: 95 % together, ascending
  std::vector<Rival> rivals;   // the others, likeliest first
};

struct SeriesChanges {
  std::vector<FoundChange> changes;  // in the order of their logs
  Scatter scatter;                   // given them
  Eigen::VectorXd level;             // the parameters of the first log
};

// Bayesian selection of changes. Each is given a prior probability (its share,
// spread over its forms and places) and its Bayes factor given the others,
// integrated over its size and over how much logs differ anyway. The likeliest
// is taken in while there is one likelier than none; then each is exchanged for
// the likeliest in its place until all stay, and those that are not `certain`
// are left out. `times`: when the logs were recorded, ascending, any unit.
SeriesChanges FindChanges(const std::vector<LogEquations>& logs,
                          const std::vector<ScatterComponent>& components,
                          const std::vector<ChangeHypothesis>& hypotheses,
                          const Eigen::VectorXd& times);

}  // namespace armcal
