#include "calib/torque_levels.h"

#include <algorithm>

#include "calib/singular_values.h"
#include "calib/triangular_factor.h"
#include "problems/joint_columns.h"
#include "problems/motion_functions.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBatch = 256;
constexpr int kEvery = 4;  // samples; a log has 16 in a period of its bandwidth

ModelParameters FreeParameters(const Robot& robot) {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kArmature};
  options.transitions.assign(robot.num_joints(), {CoulombTransition()});
  return ModelParameters(robot, options);
}

// Equations of all logs: of x, then of each log's constants.
class Equations {
 public:
  Equations(const ModelParameters& parameters, int num_logs)
      : n_(parameters.num_joints()),
        size_(parameters.size()),
        factor_(size_ + n_ * num_logs) {
    for (int log = 0; log < num_logs; ++log)
      regressors_.emplace_back(parameters);
    columns_.Resize(RowSizes(regressors_[0], 0), kBatch);
  }

  void Add(int log, const Trajectory& t) {
    MotionRegressor& regressor = regressors_[log];
    regressor.Enter(t);
    VectorXd row(factor_.columns());
    for (int first = t.core_begin; first < t.core_end; first += kBatch) {
      const int count = std::min(kBatch, t.core_end - first);
      regressor.Differential(first, count, columns_.data(), columns_.stride());
      for (int s = 0; s < count; s += kEvery) {
        if (regressor.Useless(first + s)) continue;
        for (int i = 0; i < n_; ++i) {
          const auto& used = regressor.row_columns()[i];
          row.setZero();
          for (size_t c = 0; c < used.size(); ++c) {
            row[used[c]] = columns_.column(i, static_cast<int>(c))[s];
          }
          row[size_ + n_ * log + i] = 1;
          factor_.Add(row.transpose(), t.tau(first + s, i), 1);
        }
      }
    }
  }

  // The shortest of all solutions, columns of equal size.
  VectorXd Solve() const {
    constexpr double kRank = 1e-9;
    const int size = factor_.columns();
    const MatrixXd R = factor_.Triangle().topLeftCorner(size, size);
    VectorXd scale = R.colwise().norm().transpose();
    for (double& s : scale) s = s > 0 ? 1 / s : 0;
    const SingularValues svd = DecomposeSingular(R * scale.asDiagonal());
    VectorXd x = svd.U.transpose() * factor_.Triangle().col(size).head(size);
    for (int k = 0; k < size; ++k) {
      x[k] = svd.s[k] > kRank * svd.s[0] ? x[k] / svd.s[k] : 0;
    }
    return scale.cwiseProduct(svd.V * x);
  }

 private:
  int n_, size_;
  TriangularFactor factor_;
  std::vector<MotionRegressor> regressors_;
  JointColumns columns_;
};

}  // namespace

std::vector<VectorXd> TorqueLevels(const Robot& robot, LogSet* logs) {
  const int n = robot.num_joints();
  const ModelParameters parameters = FreeParameters(robot);
  Equations equations(parameters, logs->size());
  logs->ForEach("levels of torques", {},
                [&](int log, const Trajectory& t) { equations.Add(log, t); });
  const VectorXd x = equations.Solve();
  std::vector<VectorXd> levels;
  for (int log = 0; log < logs->size(); ++log) {
    levels.emplace_back(x.segment(parameters.size() + n * log, n));
    for (int j = 0; j < n; ++j) {
      levels.back()[j] -= robot.links[j].joint.offset;
    }
  }
  return levels;
}

}  // namespace armcal
