#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Motion at many samples as kernels read it: an array of samples per joint, and
// one per Coulomb column of a model with the states of its friction.
struct MotionColumns {
  MotionColumns() = default;
  // Samples from `first` on of matrices with samples in rows (Trajectory,
  // Motion, CoulombStates::Follow); empty where a matrix has no columns.
  MotionColumns(const Eigen::MatrixXd& q, const Eigen::MatrixXd& qd,
                const Eigen::MatrixXd& qdd, const Eigen::MatrixXd& coulomb,
                Eigen::Index first = 0)
      : q(Columns(q, first)),
        qd(Columns(qd, first)),
        qdd(Columns(qdd, first)),
        coulomb(Columns(coulomb, first)) {}

  std::vector<const double*> q;        // rad or m
  std::vector<const double*> qd;       // rad/s or m/s
  std::vector<const double*> qdd;      // rad/s^2 or m/s^2
  std::vector<const double*> coulomb;  // -1 to 1

 private:
  static std::vector<const double*> Columns(const Eigen::MatrixXd& x,
                                            Eigen::Index first) {
    std::vector<const double*> columns;
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      columns.push_back(x.data() + j * x.rows() + first);
    }
    return columns;
  }
};

}  // namespace armcal
