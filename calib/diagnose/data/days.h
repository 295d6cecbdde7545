#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/baseline.h"

namespace armcal {

// Columns of friction that differs from day to day, and of torques' zeros.
std::vector<int> DayColumns(const GapBaseline& baseline);
std::vector<int> ZeroColumns(const GapBaseline& baseline);

// Of zeros of torques that have moved, x in their standard deviations: those
// that moved by more than the others scatter, and those that are worth telling
// among all that moved. None where all are held, at 0.
std::vector<int> BeyondTheOthers(const GapBaseline& baseline,
                                 const Eigen::VectorXd& x);
std::vector<int> NotableZeros(const GapBaseline& baseline,
                              const Eigen::VectorXd& x);

// Of the days' columns of one joint term, x in their standard deviations: those
// that changed by more than one, where the joints together, or their mean,
// changed by more than chance has it (ChanceBeyond, two tests: twice the
// smaller tail of chi squared), on two joints at least: one change, as
// temperature makes it. Empty: friction is that of an ordinary other day.
std::vector<int> ChangedTogether(const GapBaseline& baseline, JointTerm term,
                                 const Eigen::VectorXd& x,
                                 const Eigen::MatrixXd& covariance);

// Whether x (with its covariance) says that logs are of another day than their
// reference: friction differs on three joints, on all of smaller arms, or has
// changed together.
bool IsAnotherDay(const GapBaseline& baseline, const Eigen::VectorXd& x,
                  const Eigen::MatrixXd& covariance);

}  // namespace armcal
