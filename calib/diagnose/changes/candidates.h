#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/changes/hypothesis.h"
#include "calib/diagnose/changes/series_fit.h"

namespace armcal {

// A change of one hypothesis and course.
struct ChangeCandidate {
  int hypothesis;
  ChangeCourse course;
  double log_odds;  // against none, prior and Bayes factor
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;
};
using ChangeCandidates = std::vector<ChangeCandidate>;

// What a series is judged by.
struct SeriesProblem {
  const std::vector<LogEquations>& logs;
  const std::vector<ScatterComponent>& components;
  const std::vector<ChangeHypothesis>& hypotheses;
  const Eigen::VectorXd& times;
};

// All candidates given the changes whose columns (with priors) are given,
// likeliest first. First all at the scatter as it is; those of the likeliest
// hypotheses then also over how large their scatter may be: with few logs, two
// that differ from two others may do so by chance.
ChangeCandidates JudgeCandidates(const SeriesProblem& problem,
                                 const Scatter& scatter,
                                 const LogColumns& columns,
                                 const Eigen::VectorXd& prior);

}  // namespace armcal
