#pragma once

#include <unsupported/Eigen/AutoDiff>

#include "model/dynamics/model_parameters.h"
#include "tests/fixtures/random_motion.h"

namespace armcal {

// One sample's P, D and U of the model parameters by automatic differentiation.
struct DualRegressor {
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

  DualRegressor(const ModelParameters& parameters, const RandomMotion& motion,
                int s) {
    const RegressorColumns columns = parameters.MakeRegressor().columns();
    const int n = parameters.num_joints();
    const auto m = static_cast<int>(columns.moments.size());
    MomentumRegressor<Dual> regressor(parameters.chain(),
                                      parameters.unknown_lengths());
    MomentumRegressor<Dual>::Vector q(n), qd(n);
    for (int j = 0; j < n; ++j) {
      q[j] = Dual(motion.q(s, j), Eigen::Matrix<double, 1, 1>(motion.qd(s, j)));
      qd[j] =
          Dual(motion.qd(s, j), Eigen::Matrix<double, 1, 1>(motion.qdd(s, j)));
    }
    MomentumRegressor<Dual>::Matrix P_dual(n, m), D_dual(n, m);
    regressor.Evaluate(q, qd, columns.moments, &P_dual, &D_dual);
    P.setZero(n, parameters.size());
    U = D = P;
    for (int c = 0; c < m; ++c) {
      const int to = columns.moment_index[c];
      for (int i = 0; i <= columns.moments[c].block; ++i) {
        P(i, to) = P_dual(i, c).value();
        D(i, to) = D_dual(i, c).value();
        U(i, to) = P_dual(i, c).derivatives()[0] - D(i, to);
      }
    }
    int coulomb = 0;
    for (size_t c = 0; c < columns.terms.size(); ++c) {
      const JointTermColumn& term = columns.terms[c];
      const int j = term.joint, to = columns.term_index[c];
      const double state =
          term.term == JointTerm::kCoulomb ? motion.coulomb(s, coulomb++) : 0;
      P(j, to) = term.P(motion.qd(s, j));
      D(j, to) = term.D(motion.qd(s, j), state);
      U(j, to) = term.Torque(motion.qd(s, j), motion.qdd(s, j), state);
    }
  }
  Eigen::MatrixXd P, D, U;
};

}  // namespace armcal
