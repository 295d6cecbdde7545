#include "calib/diagnose/select/selection.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tests/fixtures/sample_motion.h"

namespace armcal::selection_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr int kRows = 1000;  // of each of two joints

VectorXd Noise(std::mt19937_64* random, double size = 1) {
  VectorXd x(kRows);
  for (double& value : x) value = size * Normal(random);
  return x;
}

// Effects that are columns, beside a baseline of one constant that is known.
class GapSelectionTest : public testing::Test {
 protected:
  GapSelectionTest() : effects_(20), target_(2, VectorXd::Zero(kRows)) {
    for (Effect& effect : effects_) effect.parameters.resize(1);
  }

  // The k-th effect's next shape on a joint.
  int Add(int effect, int joint, const VectorXd& column, int tried = 1) {
    GapCandidate candidate;
    candidate.effect = &effects_[effect];
    candidate.joint = joint;
    candidate.linear = {0};
    candidate.tried = tried;
    candidate.columns = {static_cast<int>(columns_.size())};
    JointRows rows(2);
    rows[joint] = column;
    columns_.push_back(rows);
    candidates_.push_back(candidate);
    return static_cast<int>(candidates_.size()) - 1;
  }
  // Each an effect of its own on joint 1.
  void AddRandom(int count) {
    for (int k = 0; k < count; ++k) Add(k, 0, Noise(&random_));
  }
  // A second linear parameter of the candidate's effect, and its column.
  VectorXd AddPart(int candidate) {
    const VectorXd column = Noise(&random_);
    GapCandidate& law = candidates_[candidate];
    law.linear = {0, 1};
    law.columns.push_back(static_cast<int>(columns_.size()));
    columns_.push_back({column, {}});
    effects_[candidate].parameters.resize(2);
    return column;
  }
  GapScreen Screen() const {
    const MatrixXd baseline = MatrixXd::Constant(kRows, 1, 1e-3);
    GapScreen screen(OnEachJoint({baseline, baseline}), 1, target_);
    for (const JointRows& column : columns_) screen.AddColumn(column);
    screen.Factor();
    return screen;
  }
  Selection Select(const SelectionOptions& options = {}) const {
    return SelectEffects(Screen(), candidates_, options);
  }
  const VectorXd& Column(int candidate) const {
    return columns_[candidate][candidates_[candidate].joint];
  }

  std::mt19937_64 random_{7};
  std::vector<Effect> effects_;
  std::vector<GapCandidate> candidates_;
  std::vector<JointRows> columns_;
  JointRows target_;
};

// One that explains most alone, and one that explains most of its rest, are no
// two that explain all: no single exchange leads from those to these.
TEST_F(GapSelectionTest, TwoTogetherMayBeatTheBestAlone) {
  const int a = Add(0, 0, Noise(&random_)), b = Add(1, 0, Noise(&random_));
  const VectorXd sum = Column(a) + Column(b), beside = Noise(&random_, .4);
  Add(2, 0, sum + beside);
  Add(3, 0, beside + Noise(&random_, .1));
  AddRandom(5);
  target_[0] = 3 * sum + Noise(&random_);
  EXPECT_THAT(Select().chosen, UnorderedElementsAre(a, b));
}

TEST_F(GapSelectionTest, TheRightOneIsChosen) {
  AddRandom(20);
  target_[0] = .3 * Column(13) + Noise(&random_);
  target_[1] = Noise(&random_);
  EXPECT_THAT(Select().chosen, ElementsAre(13));
}

TEST_F(GapSelectionTest, NothingIsFoundInNoise) {
  AddRandom(20);
  for (int k = 0; k < 50; ++k) {
    target_ = {Noise(&random_), Noise(&random_)};
    EXPECT_THAT(Select().chosen, IsEmpty());
  }
}

// 0.95 of its columns is another's.
TEST_F(GapSelectionTest, ALikelyNameIsNotTheRightOne) {
  AddRandom(18);
  Add(18, 0, .95 * Column(4) + Noise(&random_, .31));
  target_[0] = .5 * Column(4) + Noise(&random_);
  EXPECT_THAT(Select().chosen, ElementsAre(4));
  target_[0] = .5 * Column(18) + Noise(&random_);
  EXPECT_THAT(Select().chosen, ElementsAre(18));
}

// The torque at a large size is that of sizes near it: what fits a tenth of it
// is a small one of another course. The least squares of a x, |x - 1| <= the
// factor of two, are those of x held at its bound: 2 x g - x^2 G.
TEST_F(GapSelectionTest, ALargeSizeIsNoSmallOne) {
  const int large = Add(0, 0, Noise(&random_)),
            small = Add(1, 0, Column(large));
  effects_[0].larger_sizes = {10};
  candidates_[large].is_larger = true;
  candidates_[large].least = .5;
  candidates_[large].most = 2;
  const double G = Column(large).squaredNorm();
  const auto score = [&](int candidate, double share) {
    target_[0] = share * Column(large);
    return ScoresGiven(Screen(), candidates_, {}, {}, -1)[candidate] +
           Penalty(Screen(), candidates_[candidate]);
  };
  EXPECT_NEAR(score(small, .4), .16 * G, 1e-3 * G);
  EXPECT_NEAR(score(large, .4), (2 * .5 * .4 - .25) * G, 1e-3 * G);
  EXPECT_NEAR(score(large, 1.3), 1.69 * G, 1e-3 * G);
  EXPECT_NEAR(score(large, 3), (2 * 2 * 3 - 4) * G, 1e-3 * G);
  EXPECT_EQ(score(large, .1), 0);
  EXPECT_EQ(score(large, -1), 0);
}

// Two that explain alike: the one that was likelier before the data is chosen,
// and the other one where these speak clearly for it.
TEST_F(GapSelectionTest, WhatWasImprobableBeforehandNeedsMore) {
  AddRandom(10);
  const int improbable = Add(10, 0, Column(3) + Noise(&random_, .05));
  target_[0] = .3 * Column(improbable) + Noise(&random_);
  candidates_[improbable].prior_penalty = 50;
  EXPECT_THAT(Select().chosen, ElementsAre(3));
  target_[0] = 20 * Column(improbable) + Noise(&random_);
  EXPECT_THAT(Select().chosen, ElementsAre(improbable));
}

// A third that is nearly the sum of both is better than either alone.
TEST_F(GapSelectionTest, TwoTakeThePlaceOfTheirCompromise) {
  AddRandom(10);
  const int compromise =
      Add(10, 0, Column(2) + Column(5) + Noise(&random_, .7));
  target_[0] = Column(2) + Column(5);
  SelectionOptions options;
  options.most_effects = 1;
  EXPECT_THAT(Select(options).chosen, ElementsAre(compromise));
  options.most_effects = 2;
  EXPECT_THAT(Select(options).chosen, UnorderedElementsAre(2, 5));
}

TEST_F(GapSelectionTest, WhatCanOnlyBePositiveIsNotFoundNegative) {
  AddRandom(5);
  effects_[3].parameters[0].sign = EffectParameter::Sign::kPositive;
  target_[0] = .5 * Column(3);
  EXPECT_THAT(Select().chosen, ElementsAre(3));
  target_[0] *= -1;
  EXPECT_THAT(Select().chosen, IsEmpty());
}

// Of two that can only be positive, one may be 0: the other is found.
TEST_F(GapSelectionTest, APartThatIsNotThereIsNoObstacle) {
  AddRandom(5);
  const VectorXd other = AddPart(3);
  for (EffectParameter& parameter : effects_[3].parameters) {
    parameter.sign = EffectParameter::Sign::kPositive;
  }
  target_[0] = .5 * Column(3) - .02 * other;
  EXPECT_THAT(Select().chosen, ElementsAre(3));
  target_[0] = -.5 * Column(3) - .5 * other;
  EXPECT_THAT(Select().chosen, IsEmpty());
}

// A mass and an inertia of the same sign, of a body that was put on or taken
// off: what asks for the other sign is something else.
TEST_F(GapSelectionTest, APartHasTheSignOfTheFirst) {
  AddRandom(5);
  const VectorXd other = AddPart(3);
  effects_[3].parameters[1].sign = EffectParameter::Sign::kAsFirst;
  const auto explained = [&](double first, double second) {
    target_[0] = first * Column(3) + second * other;
    return ScoresGiven(Screen(), candidates_, {}, {}, -1)[3] +
           Penalty(Screen(), candidates_[3]);
  };
  const double both = explained(.5, .2), one = explained(.5, 0);
  EXPECT_GT(both, one + 20);
  EXPECT_NEAR(explained(-.5, -.2), both, 1e-6 * both);
  for (const double sign : {1., -1.}) {
    const double found = explained(sign * .5, -sign * .2);
    const double by_first =
        std::pow(target_[0].dot(Column(3)), 2) / Column(3).squaredNorm();
    EXPECT_NEAR(found, by_first, 1e-3 * by_first);
  }
}

TEST_F(GapSelectionTest, ShapesOfOneEffectAreNotTwoEffects) {
  AddRandom(3);
  const int other = Add(2, 0, Noise(&random_));
  target_[0] = .5 * Column(2) + .5 * Column(other);
  EXPECT_EQ(Select().chosen.size(), 1u);
  candidates_[other].effect = &effects_[3];
  EXPECT_THAT(Select().chosen, UnorderedElementsAre(2, other));
}

TEST_F(GapSelectionTest, NoMoreThanAskedFor) {
  AddRandom(8);
  for (int k = 0; k < 4; ++k) target_[0] += Column(k);
  EXPECT_EQ(Select().chosen.size(), 3u);
}

// Columns that touch different rows: every figure is known without solving.
TEST_F(GapSelectionTest, DeltaChi2AndScoresAreThoseCountedByHand) {
  VectorXd first = VectorXd::Zero(kRows), second = first;
  first.head(100).setConstant(1);
  second.tail(50).setConstant(2);
  Add(0, 0, second, 10);
  Add(1, 0, first);
  target_[0] = 3 * first - second;
  const Selection selection = Select();
  EXPECT_THAT(selection.chosen, ElementsAre(1, 0));  // 900 and 200
  EXPECT_NEAR(selection.delta_chi2[0], 900, .1);
  EXPECT_NEAR(selection.delta_chi2[1], 200, .1);
  EXPECT_NEAR(selection.scores[0], 900 - std::log(1000), .1);
  EXPECT_NEAR(selection.scores[1], 200 - std::log(1000) - 2 * std::log(10), .1);
  SelectionOptions options;
  options.inflation = 4;
  EXPECT_NEAR(Select(options).scores[0], 225 - std::log(1000), .1);
}

TEST_F(GapSelectionTest, ThePenaltyIsOfItsJointsRowsAndShapes) {
  Add(0, 0, Noise(&random_), 7);
  candidates_[0].linear = {0, 1};
  const GapScreen screen = Screen();
  EXPECT_NEAR(Penalty(screen, candidates_[0]),
              2 * std::log(1000) + 2 * std::log(7), 1e-9);
  candidates_[0].joint = -1;  // of all joints
  EXPECT_NEAR(Penalty(screen, candidates_[0]),
              2 * std::log(2000) + 2 * std::log(7), 1e-9);
}

// A shape that was fitted costs as any parameter, or as the grid did.
TEST_F(GapSelectionTest, AFittedShapeIsPaidFor) {
  Add(0, 0, Noise(&random_), 9);
  const GapScreen screen = Screen();
  const double row = std::log(1000);
  EXPECT_NEAR(RefinedPenalty(screen, candidates_[0], 3), 3 * row, 1e-9);
  EXPECT_NEAR(RefinedPenalty(screen, candidates_[0], 1), row + 2 * std::log(9),
              1e-9);
}

// Where one effect stands already, its form is never quite right.
TEST_F(GapSelectionTest, ASmallOneCountsOnAnotherJointOnly) {
  VectorXd large = VectorXd::Zero(kRows), small = large;
  large.head(100).setConstant(10);  // delta chi^2 10000
  small.tail(100).setConstant(1);   // delta chi^2 100, 1 %
  Add(0, 0, large);
  const int same = Add(1, 0, small);
  target_[0] = large + small;
  EXPECT_THAT(Select().chosen, ElementsAre(0));
  candidates_[same].joint = 1;
  std::swap(columns_[same][0], columns_[same][1]);
  target_ = {large, small};
  EXPECT_THAT(Select().chosen, ElementsAre(0, same));
}

// A law beside its mean on one joint: that the two are large does not make a
// third on another joint too small.
TEST_F(GapSelectionTest, OnlyWhatIsNewHasToBeLarge) {
  AddRandom(2);
  const int other = Add(2, 1, Noise(&random_));
  target_[0] = 3 * Column(0) + 2 * Column(1);
  target_[1] = .4 * Column(other);  // 1 % of it
  EXPECT_THAT(Select().chosen, UnorderedElementsAre(0, 1, other));
}

// What the whole robot shows is no error of form where other joints show it.
TEST_F(GapSelectionTest, AnEffectOfTheRobotIsJudgedByOtherJoints) {
  AddRandom(1);
  const int robot = Add(1, 0, Noise(&random_));
  candidates_[robot].joint = -1;
  target_[0] = 3 * Column(0) + .3 * columns_[robot][0];
  EXPECT_THAT(Select().chosen, ElementsAre(0));  // 1 %, all of it there
  columns_[robot][1] = Noise(&random_);
  target_[1] = .3 * columns_[robot][1];
  EXPECT_THAT(Select().chosen, ElementsAre(0, robot));
}

// The form of the first is not quite right; what that leaves on its joint is
// more than another joint's effect, and less than an effect.
TEST_F(GapSelectionTest, AnErrorOfFormDoesNotEndTheSearch) {
  AddRandom(2);
  const int other = Add(2, 1, Noise(&random_));
  target_[0] = 10 * Column(0) + Column(1);
  target_[1] = .8 * Column(other);
  EXPECT_THAT(Select().chosen, UnorderedElementsAre(0, other));
}

TEST_F(GapSelectionTest, ScoresOfWhatCouldStandInAPlace) {
  AddRandom(4);
  target_[0] = .5 * Column(1) + .4 * Column(2);
  const GapScreen screen = Screen();
  // In the place of 1 given 2, and given both.
  const VectorXd in_place = ScoresGiven(screen, candidates_, {}, {1, 2}, 0);
  const VectorXd given = ScoresGiven(screen, candidates_, {}, {1, 2}, -1);
  EXPECT_GT(in_place[1], 100);
  EXPECT_LT(in_place[0], 30);
  EXPECT_TRUE(std::isinf(in_place[2]));
  EXPECT_TRUE(std::isinf(given[1]) && std::isinf(given[2]));
  EXPECT_LT(given[0], 0);
  EXPECT_LT(given[3], 0);
}

}  // namespace armcal::selection_test
