#include "calib/linear/transition_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "problems/identification_rows.h"
#include "problems/make_rows.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::transition_choice_test {

using Eigen::VectorXd;
using Law = CoulombTransition::Law;

// Of the candidates, which ChooseTransitions picks per joint of a 2R arm whose
// joints have the given transitions. Slow motions reverse often enough.
std::vector<CoulombTransition> Choose(const CoulombTransition& first,
                                      const CoulombTransition& second,
                                      double coulomb, double relative_noise,
                                      std::vector<double> leave_out = {}) {
  std::mt19937_64 random(21);
  Robot robot = SampleRobot("2R planar (vertical plane)");
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) link.joint.viscous = .5;
  Log log = RecordMotion(RandomMultisine(&random, 2, .3), 30, .002);
  AddTorque(robot, &log);
  AddCoulomb(0, coulomb, first, &log);
  AddCoulomb(1, coulomb, second, &log);
  AddNoise(&random, relative_noise * ColumnRms(log.tau), &log.tau);

  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  options.transitions.assign(2, CandidateTransitions());
  const ModelParameters parameters(robot, options);
  BlockTriangularFactor factor(parameters);
  MotionRegressor regressor(parameters);
  ForEachRow(MakeTrajectory(log), RowOptions(), &regressor,
             [&](const IdentificationRow& row) {
               for (int i = 0; i < 2; ++i) {
                 factor.Add(i, row.U.row(i), row.Y[i]);
               }
             });
  VectorXd noise = RightSideRms(factor);
  for (size_t i = 0; i < leave_out.size(); ++i) noise[i] *= leave_out[i];
  std::vector<CoulombTransition> result;
  for (const int c : ChooseTransitions(factor, parameters, noise)) {
    result.push_back(CandidateTransitions()[c]);
  }
  return result;
}

// Grids step by 1.40 (velocities) and 1.46 (displacements): the nearest
// candidate lies within half a step, noise may move the choice by one more.
void ExpectFound(const CoulombTransition& found,
                 const CoulombTransition& planted, double steps) {
  EXPECT_EQ(found.law, planted.law) << planted.width << " " << found.width;
  const double step =
      planted.law == Law::kVelocity ? std::log(300.) / 17 : std::log(200.) / 14;
  EXPECT_LE(std::abs(std::log(found.width / planted.width)), steps * step)
      << planted.width << " " << found.width;
}

const CoulombTransition kPlanted[] = {{Law::kVelocity, .05},
                                      {Law::kVelocity, .01},
                                      {Law::kDisplacement, 3e-4},
                                      {Law::kDisplacement, 5e-3}};

TEST(TransitionChoice, FindsThePlantedLawWithoutNoise) {
  for (const CoulombTransition& first : kPlanted) {
    for (const CoulombTransition& second : kPlanted) {
      const auto found = Choose(first, second, 2, 0);
      ExpectFound(found[0], first, .51);
      ExpectFound(found[1], second, .51);
    }
  }
}

TEST(TransitionChoice, FindsThePlantedLawInNoise) {
  for (const CoulombTransition& planted : kPlanted) {
    const auto found = Choose(planted, planted, 2, .01);
    ExpectFound(found[0], planted, 1.51);
    ExpectFound(found[1], planted, 1.51);
  }
}

// A candidate that is planted exactly is chosen exactly.
TEST(TransitionChoice, FindsEveryCandidateItself) {
  const auto grid = CandidateTransitions();
  for (size_t c = 0; c < grid.size(); c += 4) {
    const auto found = Choose(grid[c], grid[grid.size() - 1 - c], 2, 0);
    ExpectFound(found[0], grid[c], .01);
    ExpectFound(found[1], grid[grid.size() - 1 - c], .01);
  }
}

TEST(TransitionChoice, JointsWithoutNoiseKeepTheFirst) {
  const auto found = Choose(kPlanted[0], kPlanted[0], 2, 0, {1, 0});
  ExpectFound(found[0], kPlanted[0], .51);
  EXPECT_EQ(found[1].law, Law::kVelocity);
  EXPECT_EQ(found[1].width, 1e-3);
}

TEST(TransitionChoice, Candidates) {
  const auto grid = CandidateTransitions();
  ASSERT_EQ(grid.size(), 33u);
  EXPECT_EQ(grid[0].law, Law::kVelocity);
  EXPECT_DOUBLE_EQ(grid[0].width, 1e-3);
  EXPECT_DOUBLE_EQ(grid[17].width, .3);
  EXPECT_EQ(grid[18].law, Law::kDisplacement);
  EXPECT_DOUBLE_EQ(grid[18].width, 1e-4);
  EXPECT_DOUBLE_EQ(grid[32].width, 2e-2);
}

// Friction that changes sign at once, as simulators have it, is not made
// softer than the grid's first candidate.
TEST(TransitionChoice, TheFirstCandidateMayBeSharper) {
  const auto grid = CandidateTransitions();
  const auto finer = FinerTransitions(grid[0]);
  EXPECT_DOUBLE_EQ(finer.front().width, 1e-7);
  EXPECT_DOUBLE_EQ(finer.back().width, grid[1].width);
  EXPECT_EQ(FinerTransitions(finer.front()).size(), finer.size());
  EXPECT_DOUBLE_EQ(FinerTransitions(finer.front()).back().width, grid[1].width);
  EXPECT_DOUBLE_EQ(FinerTransitions(grid[1]).front().width, grid[0].width);
  EXPECT_DOUBLE_EQ(FinerTransitions(grid[17]).back().width, grid[17].width);
}

}  // namespace armcal::transition_choice_test
