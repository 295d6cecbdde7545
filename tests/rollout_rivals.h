#pragma once

// What else one would simulate a real robot with: its file's links, and
// friction fitted to the same log.

#include <Eigen/QR>
#include <string>
#include <vector>

#include "calib/arm_unknowns.h"
#include "calib/log_set.h"
#include "model/inverse_dynamics.h"
#include "model/low_pass.h"

namespace armcal {

// `robot` with joint terms fitted by least squares to what its links leave of
// the torque of `logs`, both low-passed, without standstill. Friction and
// armature that would be negative are left out. Coulomb friction changes sign
// as `transitions` say.
inline Robot WithFittedTerms(const Robot& robot,
                             const std::vector<CoulombTransition>& transitions,
                             const std::vector<JointTerm>& terms,
                             double bandwidth_hz, LogSet* logs) {
  const int n = robot.num_joints();
  std::vector<JointTermColumn> coulomb;
  for (int j = 0; j < n; ++j) {
    coulomb.push_back({j, JointTerm::kCoulomb, transitions[j]});
  }
  CoulombStates states(coulomb);
  // Per joint: a column per term, then what the links leave.
  std::vector<std::vector<Eigen::RowVectorXd>> rows(n);
  logs->Prepare(bandwidth_hz, 0);
  logs->ForEach("", nullptr, [&](int, const Trajectory& t) {
    const Eigen::MatrixXd c = states.Follow(t);
    Eigen::MatrixXd left = t.tau;
    for (int k = 0; k < t.size(); ++k) {
      left.row(k) -=
          InverseDynamics(robot, t.q.row(k), t.qd.row(k), t.qdd.row(k));
    }
    for (int j = 0; j < n; ++j) {
      Eigen::MatrixXd columns(t.size(), terms.size() + 1);
      for (size_t p = 0; p < terms.size(); ++p) {
        for (int k = 0; k < t.size(); ++k) {
          columns(k, p) = JointTermColumn{j, terms[p], {}}.Torque(
              t.qd(k, j), t.qdd(k, j), c(k, j));
        }
      }
      columns.rightCols<1>() = left.col(j);
      columns = ZeroPhaseLowPass(columns, 1 / t.dt, bandwidth_hz);
      for (int k = t.core_begin; k < t.core_end; ++k) {
        if (!t.standstill[k]) rows[j].push_back(columns.row(k));
      }
    }
  });
  Robot fitted = robot;
  for (int j = 0; j < n; ++j) {
    Eigen::MatrixXd A(rows[j].size(), terms.size() + 1);
    for (size_t k = 0; k < rows[j].size(); ++k) A.row(k) = rows[j][k];
    std::vector<JointTerm> used = terms;
    for (;;) {
      Eigen::MatrixXd B(A.rows(), used.size());
      for (size_t p = 0; p < used.size(); ++p) {
        const auto at = std::find(terms.begin(), terms.end(), used[p]);
        B.col(p) = A.col(at - terms.begin());
      }
      const Eigen::VectorXd x = B.colPivHouseholderQr().solve(
          Eigen::VectorXd(A.rightCols<1>()));
      size_t worst = used.size();
      for (size_t p = 0; p < used.size(); ++p) {
        if (used[p] == JointTerm::kOffset || x[p] >= 0) continue;
        worst = p;
      }
      if (worst < used.size()) {
        used.erase(used.begin() + worst);
        continue;
      }
      Joint& joint = fitted.links[j].joint;
      for (const JointTerm term : terms) *TermOf(term, &joint) = 0;
      for (size_t p = 0; p < used.size(); ++p) *TermOf(used[p], &joint) = x[p];
      break;
    }
  }
  return fitted;
}

}  // namespace armcal
