#include "calib/diagnose/select/form_error.h"

#include <gmock/gmock.h>

#include "tests/calib/diagnose/select/selected_columns.h"

namespace armcal::form_error_test {

using Eigen::VectorXd;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

using FormErrorTest = SelectedColumns;

// Where one effect stands already, its form is never quite right.
TEST_F(FormErrorTest, ASmallOneCountsOnAnotherJointOnly) {
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
TEST_F(FormErrorTest, OnlyWhatIsNewHasToBeLarge) {
  AddRandom(2);
  const int other = Add(2, 1, Noise(&random_));
  target_[0] = 3 * Column(0) + 2 * Column(1);
  target_[1] = .4 * Column(other);  // 1 % of it
  EXPECT_THAT(Select().chosen, UnorderedElementsAre(0, 1, other));
}

// What the whole robot shows is no error of form where other joints show it.
TEST_F(FormErrorTest, AnEffectOfTheRobotIsJudgedByOtherJoints) {
  AddRandom(1);
  const int robot = Add(1, 0, Noise(&random_));
  candidates_[robot].joint = -1;
  target_[0] = 3 * Column(0) + .3 * columns_[robot][0];
  EXPECT_THAT(Select().chosen, ElementsAre(0));  // 1 %, all of it there
  columns_[robot][1] = Noise(&random_);
  target_[1] = .3 * columns_[robot][1];
  EXPECT_THAT(Select().chosen, ElementsAre(0, robot));
}

// A tool explains 9000 on joint 1, an error of whose form is no less there, and
// 90 on joint 2, where an effect of 160 is more than such an error. Of another
// effect of the robot, whose law may be wrong anywhere, nobody knows.
TEST_F(FormErrorTest, ABodysErrorIsAShareOfWhatItExplainsThere) {
  AddRandom(1);
  const int tool = Add(1, 0, Noise(&random_));
  candidates_[tool].joint = -1;
  columns_[tool][1] = .1 * Noise(&random_);
  const int here = Add(2, 0, Noise(&random_));
  const int there = Add(3, 1, Noise(&random_));
  target_[0] = 3 * columns_[tool][0] + .4 * Column(here);
  target_[1] = 3 * columns_[tool][1] + .4 * Column(there);
  EXPECT_THAT(Select().chosen, ElementsAre(tool));
  effects_[1].parameters.resize(2);
  effects_[1].parameters[1].sign = EffectParameter::Sign::kAsFirst;
  EXPECT_THAT(Select().chosen, UnorderedElementsAre(tool, there));
  const GapScreen screen = Screen();
  EXPECT_NEAR(DeltaChi2WhereActs(screen, candidates_, {tool, there}, 0, 1),
              .09 * kRows, .1 * .09 * kRows);
  EXPECT_NEAR(DeltaChi2WhereActs(screen, candidates_, {tool, here}, 0, 1),
              9 * kRows, .1 * 9 * kRows);
}

// The form of the first is not quite right; what that leaves on its joint is
// more than another joint's effect, and less than an effect.
TEST_F(FormErrorTest, AnErrorOfFormDoesNotEndTheSearch) {
  AddRandom(2);
  const int other = Add(2, 1, Noise(&random_));
  target_[0] = 10 * Column(0) + Column(1);
  target_[1] = .8 * Column(other);
  EXPECT_THAT(Select().chosen, UnorderedElementsAre(0, other));
}

}  // namespace armcal::form_error_test
