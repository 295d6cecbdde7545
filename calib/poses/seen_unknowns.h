#pragma once

#include <Eigen/Core>

namespace armcal {

// What equations with the rows A alone tell of their unknowns, of which there
// may be more than they see.
struct SeenUnknowns {
  explicit SeenUnknowns(const Eigen::MatrixXd& A);
  // A half is an orthonormal basis of A's columns, so that half half' is the
  // pseudo-inverse of A'A.
  Eigen::MatrixXd half;
  Eigen::VectorXd unseen;  // of each unknown, the share that no row sees
};

}  // namespace armcal
