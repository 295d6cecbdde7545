#include "calib/diagnose/candidates/candidates.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "calib/diagnose/candidates/candidate_torques.h"
#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/rows.h"
#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::candidates_test {

using Eigen::Vector2d;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

// An effect of a size and a grid.
Effect MakeEffect(const std::vector<double>& larger) {
  Effect effect;
  effect.name = "any";
  effect.parameters.resize(2);
  effect.larger_sizes = larger;
  return effect;
}

GapCandidate MakeCandidate(const Effect& effect, int joint) {
  GapCandidate candidate;
  candidate.effect = &effect;
  candidate.joint = joint;
  candidate.p = Vector2d(0, 5);
  candidate.linear = {0};
  candidate.size = VectorXd::Constant(1, .1);
  candidate.tried = 3;
  candidate.torque = {JointRows(1, VectorXd::Ones(4))};
  return candidate;
}

TEST(GapCandidates, LargerOnesAreMultiplesAndAllWereTried) {
  const Effect effect = MakeEffect({2, 4, 8});
  const auto larger = LargerOnes(MakeCandidate(effect, 0));
  ASSERT_EQ(larger.size(), 3u);
  EXPECT_DOUBLE_EQ(larger[0].size[0], .2);
  EXPECT_DOUBLE_EQ(larger[2].size[0], .8);
  for (const GapCandidate& one : larger) {
    EXPECT_EQ(one.tried, 3 * (1 + 3));
    EXPECT_TRUE(one.is_larger);
    EXPECT_TRUE(one.torque.empty());  // another size's
    EXPECT_EQ(one.p[1], 5);
  }
  EXPECT_EQ(LargerOnes(MakeCandidate(MakeEffect({}), 0)).size(), 0u);
}

// Bayes' rule in closed form: odds of 9 against a hypothesis are ln 9 of its
// log likelihood, of which chi squared is twice as large and is divided by the
// temperature of 4.
TEST(PriorPenalty, IsTheLogarithmOfOddsSinceAReference) {
  Effect effect = MakeEffect({});
  EXPECT_EQ(PriorPenalty(effect, true), 0);
  effect.of_construction = true;
  EXPECT_EQ(PriorPenalty(effect, false), 0);
  EXPECT_NEAR(PriorPenalty(effect, true), 2 * 4 * std::log(9.), 1e-12);
}

// What is bolted, cast or wound; not what is mounted, set, worn or warmed.
TEST(PriorPenalty, KnowsWhatAnArmIsBuiltOf) {
  std::vector<std::string> built;
  for (const Effect& effect : Effects()) {
    if (effect.of_construction) built.push_back(effect.name);
  }
  EXPECT_THAT(built,
              UnorderedElementsAre("link_length", "link_inertia", "armature"));
}

// A link of n has an n-th of the odds of a body at the
// tool; one on the last link is that. In the units of the test above.
TEST(ListCandidates, LinksShareTheOddsOfABody) {
  const EffectArm arm("UR5 6R", 20, .01);
  const int n = arm.robot.num_joints();
  const GapBaseline baseline(arm.robot, {}, Eigen::VectorXd::Constant(n, 10));
  const std::vector<GapSegment> segments = {
      MakeSegment(arm.motion, arm.Recorded().nominal())};
  GapRows rows(segments, 6);
  rows.SetNoise(std::vector<Autoregression>(n),
                Eigen::MatrixXd::Zero(rows.num_thin(), n));
  std::vector<std::string> others;
  for (const Effect& effect : Effects()) {
    if (!IsCarriedBody(effect)) others.push_back(effect.name);
  }
  int links = 0, tools = 0;
  for (const bool since_reference : {false, true}) {
    const std::vector<GapCandidate> bodies = ListCandidates(
        baseline, rows, arm.scale, Eigen::MatrixXd::Zero(rows.num_thin(), n),
        others, since_reference);
    const auto on_links = static_cast<double>(
        std::count_if(bodies.begin(), bodies.end(),
                      [](const auto& b) { return b.joint >= 0; }));
    for (const GapCandidate& body : bodies) {
      const bool is_on_a_link = body.joint >= 0;
      (is_on_a_link ? links : tools) += 1;
      EXPECT_NEAR(body.prior_penalty,
                  is_on_a_link ? 2 * 4 * std::log(on_links) : 0, 1e-12);
    }
  }
  EXPECT_GE(links, 4);
  EXPECT_EQ(tools, 2);
}

// From all over the range.
TEST(GapCandidates, AFewOfManyAreSpread) {
  std::vector<double> sizes;
  for (int k = 1; k <= 20; ++k) sizes.push_back(k);
  const Effect effect = MakeEffect(sizes);
  const auto few = FewLargerOnes(MakeCandidate(effect, 0));
  ASSERT_EQ(few.size(), 5u);
  EXPECT_DOUBLE_EQ(few[0].size[0], .3);
  EXPECT_DOUBLE_EQ(few[2].size[0], 1.1);
  EXPECT_DOUBLE_EQ(few[4].size[0], 1.9);
  EXPECT_EQ(few[0].tried, 3 * 21);
}

TEST(GapCandidates, UsualShapesAreOneOfEachPlace) {
  const Effect grows = MakeEffect({2}), linear = MakeEffect({});
  EXPECT_THAT(UsualShapes({MakeCandidate(linear, 0), MakeCandidate(grows, 0),
                           MakeCandidate(grows, 0), MakeCandidate(grows, 1)}),
              ElementsAre(1, 3));
  // The first of them that is of the usual shape, wherever that stands.
  GapCandidate odd = MakeCandidate(grows, 0);
  odd.is_usual = false;
  EXPECT_THAT(UsualShapes({odd, odd, MakeCandidate(grows, 0)}), ElementsAre(2));
  EXPECT_THAT(UsualShapes({odd, odd}), ElementsAre(0));
}

// A gear that rings for long, the first of the grid, would hide one that does
// not from the few sizes that are tried everywhere.
TEST(GapCandidates, OfAGearTheUsualIsOfMiddleDamping) {
  const EffectArm arm("2R planar (vertical plane)", 20, .01);
  const GapBaseline baseline(arm.robot, {}, Eigen::VectorXd::Constant(2, 10));
  const std::vector<GapSegment> segments = {
      MakeSegment(arm.motion, arm.Recorded().nominal())};
  GapRows rows(segments, 6);
  rows.SetNoise(std::vector<Autoregression>(2),
                Eigen::MatrixXd::Zero(rows.num_thin(), 2));
  std::vector<std::string> others;
  for (const Effect& effect : Effects()) {
    if (effect.name != "elasticity") others.push_back(effect.name);
  }
  const std::vector<GapCandidate> candidates =
      ListCandidates(baseline, rows, arm.scale,
                     Eigen::MatrixXd::Zero(rows.num_thin(), 2), others, false);
  const std::vector<int> usual = UsualShapes(candidates);
  ASSERT_EQ(usual.size(), 2u);  // joints
  for (const int c : usual) {
    EXPECT_TRUE(candidates[c].is_usual);
    EXPECT_EQ(candidates[c].p[1], .07) << "of .005, .02, .07 and .25";
    EXPECT_EQ(candidates[c].p[2], .01) << "of .01 and .05";
  }
}

// Events are taken out, and all candidates listed again.
TEST(GapCandidates, TorquesAreThoseOfTheSameCandidate) {
  const Effect effect = MakeEffect({2});
  std::vector<GapCandidate> evaluated = {MakeCandidate(effect, 0),
                                         MakeCandidate(effect, 1)};
  evaluated[0].torque[0][0].setConstant(7);
  std::vector<GapCandidate> again = evaluated;
  for (GapCandidate& one : again) one.torque.clear();
  again.push_back(again[0]);
  again.back().size *= 2;
  again.push_back(again[1]);
  again.back().p[1] = 6;
  std::swap(again[0], again[1]);
  ReuseTorques(&evaluated, &again);
  EXPECT_EQ(again[1].torque[0][0], VectorXd::Constant(4, 7));
  EXPECT_EQ(again[0].torque[0][0], VectorXd::Ones(4));
  EXPECT_TRUE(again[2].torque.empty());
  EXPECT_TRUE(again[3].torque.empty());
  EXPECT_TRUE(evaluated[0].torque.empty());
}

// A zero is wrong to either side.
TEST(GapCandidates, SharperOnesKeepTheSign) {
  const Effect offset = MakeEffect({-30, 30});
  std::vector<GapCandidate> fitted = {MakeCandidate(offset, 0)};
  fitted[0].p = Vector2d(-.37, 6);
  EXPECT_DOUBLE_EQ(Sharper(fitted)[0].size[0], -.37);
}

// With the shape that was fitted, and the size where that matters.
TEST(GapCandidates, SharperOnesAreAtTheFit) {
  const Effect grows = MakeEffect({2}), shaped = MakeEffect({});
  Effect linear = MakeEffect({});
  linear.parameters.resize(1);
  std::vector<GapCandidate> fitted = {MakeCandidate(grows, 0),
                                      MakeCandidate(shaped, 1),
                                      MakeCandidate(linear, 2)};
  for (GapCandidate& one : fitted) one.p = Vector2d(.37, 6);
  const auto sharper = Sharper(fitted);
  ASSERT_EQ(sharper.size(), 2u);
  EXPECT_DOUBLE_EQ(sharper[0].size[0], .37);
  EXPECT_DOUBLE_EQ(sharper[1].size[0], .1);
  for (const GapCandidate& one : sharper) {
    EXPECT_EQ(one.p, Vector2d(0, 6));
    EXPECT_TRUE(one.torque.empty());
    EXPECT_EQ(one.tried, 3);
  }
}

}  // namespace armcal::candidates_test
