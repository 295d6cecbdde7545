#include "model/dynamics/joint_term.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::joint_term_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Law = CoulombTransition::Law;

// A stretch with the given positions of joint 1 and -2 times them of joint 2.
Trajectory Stretch(const std::vector<double>& q, long first_index = 0,
                   int core_begin = 0, int segment = 0) {
  Trajectory t;
  t.dt = .1;
  t.q.resize(static_cast<Eigen::Index>(q.size()), 2);
  for (size_t k = 0; k < q.size(); ++k) t.q.row(k) << q[k], -2 * q[k];
  t.qd = MatrixXd::Zero(t.q.rows(), 2);
  t.first_index = first_index;
  t.segment = segment;
  t.core_begin = core_begin;
  t.core_end = t.size();
  return t;
}

std::vector<JointTermColumn> Displacement(double width) {
  return {{0, JointTerm::kViscous, {}},
          {0, JointTerm::kCoulomb, {Law::kDisplacement, width}},
          {1, JointTerm::kCoulomb, {Law::kDisplacement, width}}};
}

VectorXd Vector(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<int>(v.size()));
}

TEST(JointTermColumn, TorqueByHand) {
  const double qd = .3, qdd = -2, c = -.6;
  const auto torque = [&](JointTerm term) {
    return JointTermColumn{0, term, {}}.Torque(qd, qdd, c);
  };
  EXPECT_EQ(torque(JointTerm::kViscous), .3);
  EXPECT_EQ(torque(JointTerm::kCoulomb), -.6);
  EXPECT_EQ(torque(JointTerm::kOffset), 1);
  EXPECT_EQ(torque(JointTerm::kArmature), -2);
}

// The torque is d/dt P - D: P of an armature is its momentum.
TEST(JointTermColumn, MomentumAndForce) {
  for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb,
                               JointTerm::kOffset, JointTerm::kArmature}) {
    const JointTermColumn column{0, term, {}};
    const double qd = .3, qdd = -2, c = .4, h = 1e-3;
    const double rate =
        (column.P(qd + h * qdd) - column.P(qd - h * qdd)) / (2 * h);
    EXPECT_NEAR(rate - column.D(qd, c), column.Torque(qd, qdd, c), 1e-12)
        << JointTermName(term);
  }
}

// By hand: of 2 qd + 5 c + .3; c = tanh(1), or the state, which yields at 1.
TEST(CoulombTransition, FrictionByHand) {
  using Law = CoulombTransition::Law;
  Joint joint;
  joint.viscous = 2;
  joint.coulomb = 5;
  joint.offset = .3;
  const CoulombTransition velocity = {Law::kVelocity, .1};
  EXPECT_NEAR(FrictionTorque(joint, velocity, .1, 9),
              .2 + 5 * 0.76159415595576485 + .3, 1e-12);
  EXPECT_EQ(velocity.StateRate(.1, 0), 0);
  const CoulombTransition displacement = {Law::kDisplacement, .1};
  EXPECT_NEAR(FrictionTorque(joint, displacement, .1, -.5), -2, 1e-12);
  EXPECT_NEAR(FrictionTorque(joint, displacement, -.1, 1.01), 5.1, 1e-12);
  EXPECT_NEAR(displacement.StateRate(.1, .5), 1, 1e-12);
  EXPECT_EQ(displacement.StateRate(.1, 1), 0);
  EXPECT_NEAR(displacement.StateRate(-.1, 1), -1, 1e-12);
}

TEST(CoulombStates, VelocityLawIsTanh) {
  CoulombStates states({{1, JointTerm::kCoulomb, {Law::kVelocity, .02}}});
  Trajectory t = Stretch({0, 0, 0, 0});
  t.qd.col(1) << 0, .02, -.01, 3;
  const MatrixXd c = states.Follow(t);
  ASSERT_EQ(c.cols(), 1);
  EXPECT_NEAR(c(0, 0), 0, 1e-15);
  EXPECT_NEAR(c(1, 0), 0.761594155955765, 1e-14);  // tanh 1
  EXPECT_NEAR(c(2, 0), -0.46211715726001, 1e-13);  // -tanh 1/2
  EXPECT_NEAR(c(3, 0), 1, 1e-15);
}

// A spring of width 0.1 that slips at 1: loads, slips, holds, unloads.
TEST(CoulombStates, PrandtlElementByHand) {
  CoulombStates states(Displacement(.1));
  ASSERT_EQ(states.size(), 2);
  const MatrixXd c =
      states.Follow(Stretch({3, 3.05, 3.2, 3.2, 3.17, 3.05, 2, 2.04}));
  const VectorXd expected = Vector({0, .5, 1, 1, .7, -.5, -1, -.6});
  EXPECT_LT((c.col(0) - expected).cwiseAbs().maxCoeff(), 1e-12);
  // Joint 2 moves twice as far the other way.
  const VectorXd other = Vector({0, -1, -1, -1, -.4, 1, 1, .2});
  EXPECT_LT((c.col(1) - other).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CoulombStates, CarriesTheStateAlongASegment) {
  std::vector<double> q;
  for (int k = 0; k < 100; ++k) q.push_back(.07 * std::sin(.2 * k) + .001 * k);
  const MatrixXd whole = CoulombStates(Displacement(.1)).Follow(Stretch(q));
  CoulombStates states(Displacement(.1));
  // Stretches of cores of 20 samples with 8 more on both sides.
  for (int core = 0; core < 100; core += 20) {
    const int begin = std::max(0, core - 8), end = std::min(100, core + 28);
    const MatrixXd c = states.Follow(
        Stretch({q.begin() + begin, q.begin() + end}, begin, core - begin));
    EXPECT_LT((c - whole.middleRows(begin, end - begin)).cwiseAbs().maxCoeff(),
              1e-12)
        << core;
  }
}

TEST(CoulombStates, StartsSegmentsAtZero) {
  CoulombStates states(Displacement(.1));
  states.Follow(Stretch({0, .05, .5}));
  EXPECT_EQ(states.Follow(Stretch({.5, .51}, 2))(0, 0), 1);  // the same segment
  EXPECT_EQ(states.Follow(Stretch({.5, .51}, 2, 0, 1))(0, 0), 0);
  states.Follow(Stretch({0, .05, .5}, 0, 0, 2));
  EXPECT_EQ(states.Follow(Stretch({.5, .51}, 7, 0, 2))(0, 0), 0);  // a hole
}

// Filters bend the margins of a stretch (2026-11-20: the state was carried at
// the first sample of the margin, where positions of two stretches differ).
TEST(CoulombStates, TrustsNoMarginBeforeTheCore) {
  std::vector<double> q;
  for (int k = 0; k < 60; ++k) q.push_back(.04 * std::sin(.1 * k));
  const MatrixXd whole = CoulombStates(Displacement(.1)).Follow(Stretch(q));
  CoulombStates states(Displacement(.1));
  states.Follow(Stretch({q.begin(), q.begin() + 40}));
  std::vector<double> bent(q.begin() + 20, q.end());
  bent[0] += .02;
  bent[1] -= .01;
  const MatrixXd c = states.Follow(Stretch(bent, 20, 10));
  EXPECT_LT((c - whole.bottomRows(40)).bottomRows(30).cwiseAbs().maxCoeff(),
            1e-12);
}

TEST(CoulombStates, TakesEmptyStretchesAndModelsWithout) {
  CoulombStates none({{0, JointTerm::kOffset, {}}});
  EXPECT_EQ(none.size(), 0);
  EXPECT_EQ(none.Follow(Stretch({1, 2})).cols(), 0);
  CoulombStates states(Displacement(.1));
  EXPECT_EQ(states.Follow(Stretch({})).rows(), 0);
}

// Where friction has a motion of its own, its states are of that one.
TEST(CoulombStates, FollowFrictionsOwnMotion) {
  const std::vector<JointTermColumn> columns = {
      {0, JointTerm::kCoulomb, {Law::kVelocity, .1}},
      {1, JointTerm::kCoulomb, {Law::kDisplacement, 4}}};
  Trajectory t = Stretch({0, 1, 2});
  t.friction_q = 2 * t.q;
  t.friction_qd = MatrixXd::Constant(3, 2, .05);
  const MatrixXd states = CoulombStates(columns).Follow(t);
  EXPECT_NEAR(states(2, 0), std::tanh(.5), 1e-12);
  EXPECT_NEAR(states(1, 1), -1, 1e-12);  // -4 over a width of 4
}

// Two joints that often turn round: a step is 40 of the sharpest widths.
Trajectory TurningRound(double dt) {
  Trajectory t;
  t.dt = dt;
  const auto size = static_cast<Eigen::Index>(std::lround(6 / dt)) + 1;
  const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(size, 0, 6);
  t.q.resize(size, 2);
  t.qd.resize(size, 2);
  t.q << .05 * (3 * time).sin(), .02 * (7 * time).cos();
  t.qd << .15 * (3 * time).cos(), -.14 * (7 * time).sin();
  t.core_end = t.size();
  t.thinned = true;
  return t;
}

// What a thinned torque has is the mean over the step about a row: those of
// rows that are 1000 times as close, of both laws, by the trapezoidal rule.
// What is left is the motion's bend between rows: of a position
// h^2 max |qdd| / 8, which counts against a displacement's width, and of the
// velocity at a turn less.
TEST(CoulombStates, ThinnedTorqueHasTheMeanOfAStep) {
  constexpr int kFiner = 1000;
  const Trajectory t = TurningRound(.008), fine = TurningRound(.008 / kFiner);
  std::vector<JointTermColumn> columns;
  for (int j = 0; j < 2; ++j) {
    for (const double width : {1e-7, 1e-3, .02, .3}) {
      columns.push_back({j, JointTerm::kCoulomb, {Law::kVelocity, width}});
    }
    for (const double width : {1e-4, .01}) {
      columns.push_back({j, JointTerm::kCoulomb, {Law::kDisplacement, width}});
    }
  }
  const MatrixXd states = CoulombStates(columns).Follow(fine);
  const MatrixXd means = CoulombStates(columns).FollowTorque(t);
  const MatrixXd at_rows = CoulombStates(columns).Follow(t);
  constexpr double kBend = .008 * .008 / 8;  // of 1 rad/s^2
  Eigen::ArrayXd allowed(12);
  for (int c = 0; c < 12; ++c) {
    const CoulombTransition& law = columns[c].transition;
    const double most = columns[c].joint == 0 ? .45 : .98;  // |qdd|, rad/s^2
    allowed[c] =
        law.law == Law::kVelocity ? .001 : 2 * most * kBend / law.width;
  }
  double coarse = 0;
  for (int k = 1; k + 1 < t.size(); ++k) {
    const auto step =
        states.middleRows(kFiner * k - kFiner / 2, kFiner + 1).array();
    const Eigen::ArrayXd mean =
        (step.colwise().sum() - (step.row(0) + step.row(kFiner)) / 2) / kFiner;
    const Eigen::ArrayXd off = means.row(k).transpose().array() - mean;
    EXPECT_LT((off.abs() - allowed).maxCoeff(), 0) << k << '\n'
                                                   << off.transpose();
    coarse = std::max(
        coarse, (at_rows.row(k).transpose().array() - mean).abs().maxCoeff());
  }
  EXPECT_GT(coarse, .5);  // the sign at a row for that of its step
}

TEST(CoulombStates, TorqueAsSampledHasTheStates) {
  Trajectory t = TurningRound(.008);
  t.thinned = false;
  EXPECT_EQ(CoulombStates(Displacement(1e-3)).FollowTorque(t),
            CoulombStates(Displacement(1e-3)).Follow(t));
  t = Stretch({1});
  t.thinned = true;
  EXPECT_EQ(CoulombStates(Displacement(1e-3)).FollowTorque(t),
            MatrixXd::Zero(1, 2));
}

}  // namespace armcal::joint_term_test
