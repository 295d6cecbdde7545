#pragma once

#include <Eigen/Core>

namespace armcal {

// Torques that were reconstructed from commands are right but for what
// integrals of the drives held when the log began, and for what the positions
// that a log leaves out add up to in these: a level that walks at random. It is
// told as a broken line over time, which takes what is slow out of a signal.
class TorqueDrift {
 public:
  // `times`, s, rising.
  explicit TorqueDrift(const Eigen::VectorXd& times);

  // Columns of x (a row for each time) without the broken lines that fit them
  // best, each row counting by its weight (0: not at all; such rows have it
  // taken out like others).
  Eigen::MatrixXd Without(const Eigen::MatrixXd& x,
                          const Eigen::VectorXd& weights) const;

 private:
  Eigen::VectorXd place_;  // of each row in the knots: 2.25 is between 2 and 3
  int knots_;
};

}  // namespace armcal
