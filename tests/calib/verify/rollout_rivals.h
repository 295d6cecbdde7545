#pragma once

// What else one would simulate a real robot with: its file's links, and
// friction fitted to the same log.

#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "calib/logs/log_set.h"
#include "calib/refine/arm_unknowns.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/signals/low_pass.h"

namespace armcal {

// What `robot`'s links leave of the recorded torque, samples x n.
inline Eigen::MatrixXd TorqueLeft(const Robot& robot, const Trajectory& t) {
  Eigen::MatrixXd left = t.tau;
  for (int k = 0; k < t.size(); ++k) {
    left.row(k) -=
        InverseDynamics(robot, t.q.row(k), t.qd.row(k), t.qdd.row(k));
  }
  return left;
}

// Per joint, a row per moving sample: the torque of each term's unit parameter,
// then what `robot`'s links leave of the recorded torque, all low-passed.
inline std::vector<Eigen::MatrixXd> TermRows(
    const Robot& robot, const std::vector<CoulombTransition>& transitions,
    const std::vector<JointTerm>& terms, double bandwidth_hz,
    const LogSet& logs) {
  const int n = robot.num_joints(), m = static_cast<int>(terms.size());
  std::vector<JointTermColumn> coulomb;
  for (int j = 0; j < n; ++j) {
    coulomb.push_back({j, JointTerm::kCoulomb, transitions[j]});
  }
  CoulombStates states(coulomb);
  std::vector<Eigen::MatrixXd> rows(n, Eigen::MatrixXd(0, m + 1));
  PreparationOptions prepared;
  prepared.bandwidth_hz = bandwidth_hz;
  Prepare(logs, prepared).ForEach("", nullptr, [&](int, const Trajectory& t) {
    const Eigen::MatrixXd c = states.Follow(t);
    const Eigen::MatrixXd left = TorqueLeft(robot, t);
    for (int j = 0; j < n; ++j) {
      Eigen::MatrixXd all(t.size(), m + 1);
      for (int k = 0; k < t.size(); ++k) {
        for (int p = 0; p < m; ++p) {
          all(k, p) = JointTermColumn{j, terms[p], {}}.Torque(
              t.qd(k, j), t.qdd(k, j), c(k, j));
        }
        all(k, m) = left(k, j);
      }
      all = ZeroPhaseLowPass(all, 1 / t.dt, bandwidth_hz);
      for (int k = t.core_begin; k < t.core_end; ++k) {
        if (t.standstill[k]) continue;
        rows[j].conservativeResize(rows[j].rows() + 1, Eigen::NoChange);
        rows[j].bottomRows<1>() = all.row(k);
      }
    }
  });
  return rows;
}

// Least squares of the last column on the others; of the terms, friction and
// armature that would be negative are zero.
inline Eigen::VectorXd FitTerms(const Eigen::MatrixXd& rows,
                                const std::vector<JointTerm>& terms) {
  std::vector<int> used(terms.size());
  std::iota(used.begin(), used.end(), 0);
  for (;;) {
    Eigen::MatrixXd A(rows.rows(), used.size());
    for (size_t p = 0; p < used.size(); ++p) A.col(p) = rows.col(used[p]);
    const Eigen::VectorXd y = rows.rightCols<1>();
    const Eigen::VectorXd x = A.colPivHouseholderQr().solve(y);
    const auto negative =
        std::find_if(used.begin(), used.end(), [&](const int& p) {
          return terms[p] != JointTerm::kOffset && x[&p - used.data()] < 0;
        });
    if (negative != used.end()) {
      used.erase(negative);
      continue;
    }
    Eigen::VectorXd all = Eigen::VectorXd::Zero(terms.size());
    for (size_t p = 0; p < used.size(); ++p) all[used[p]] = x[p];
    return all;
  }
}

// `robot` with joint terms fitted to what its links leave of the torque of
// `logs`, without standstill. Coulomb friction changes sign as `transitions`
// say.
inline Robot WithFittedTerms(const Robot& robot,
                             const std::vector<CoulombTransition>& transitions,
                             const std::vector<JointTerm>& terms,
                             double bandwidth_hz, const LogSet& logs) {
  Robot fitted = robot;
  const auto rows = TermRows(robot, transitions, terms, bandwidth_hz, logs);
  for (int j = 0; j < robot.num_joints(); ++j) {
    const Eigen::VectorXd x = FitTerms(rows[j], terms);
    Joint& joint = fitted.links[j].joint;
    joint.viscous = joint.coulomb = joint.offset = joint.armature = 0;
    for (size_t p = 0; p < terms.size(); ++p) *TermOf(terms[p], &joint) = x[p];
  }
  return fitted;
}

// What shared/data/panda/SOURCE.md has of Gaz et al. 2019: four gravity terms,
// which the file's links meet once their centres of mass are moved (as little
// as possible, bodies otherwise as they are), and the friction. It was fitted
// to the whole log, the held-out part included.
inline Robot WithPublishedGravity(const Robot& file) {
  Robot robot = file;
  const auto mass = [&file](int first) {  // of links first .. 7
    double sum = 0;
    for (int i = first; i <= 7; ++i) sum += file.links[i - 1].inertial.mass;
    return sum;
  };
  const auto h = [&file](int link) {
    return file.links[link - 1].inertial.first_moment;
  };
  const double a = -3.1363 - (h(2).y() - .316 * mass(3) - h(3).z());
  const double b = 1.7517 - (.384 * mass(5) + h(4).y() + h(5).z());
  const double c = -.4726 - (-.0825 * mass(5) + h(4).x());
  const double d = .1637 - (.088 * mass(7) + h(6).x());
  const auto move = [&robot](int link, const Eigen::Vector3d& moment) {
    InertialParameters& body = robot.links[link - 1].inertial;
    const Eigen::Vector3d com = body.first_moment / body.mass;
    const Eigen::Matrix3d central =
        body.inertia -
        body.mass * (com.squaredNorm() * Eigen::Matrix3d::Identity() -
                     com * com.transpose());
    body = InertialParameters::FromCenterOfMass(
        body.mass, com + moment / body.mass, central);
  };
  move(2, {0, a / 2, 0});
  move(3, {0, 0, -a / 2});
  move(4, {c, b / 2, 0});
  move(5, {0, 0, b / 2});
  move(6, {d, 0, 0});
  return robot;
}

inline Robot WithPublishedFriction(const Robot& file) {
  constexpr double kViscous[] = {.0665, .1987,  .0399, .2257,
                                 .1023, -.0132, .0638};
  constexpr double kCoulomb[] = {.2450, .1523, .1827, .3591,
                                 .2669, .1658, .2109};
  constexpr double kOffset[] = {-.1073, -.1566, -.0686, -.2522,
                                .0045,  .0910,  -.0127};
  Robot robot = file;
  for (int j = 0; j < 7; ++j) {
    robot.links[j].joint.viscous = kViscous[j];
    robot.links[j].joint.coulomb = kCoulomb[j];
    robot.links[j].joint.offset = kOffset[j];
  }
  return robot;
}

}  // namespace armcal
