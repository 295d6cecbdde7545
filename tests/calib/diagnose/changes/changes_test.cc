#include "calib/diagnose/changes/changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/diagnose/changes/report.h"
#include "tests/fixtures/log_series.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::changes_test {

using testing::HasSubstr;

// The change that is of this part and joint; null: none.
const NamedChange* Find(const LogChanges& changes, ChangedPart part,
                        int joint) {
  for (const NamedChange& change : changes.changes) {
    if (change.what.part == part && change.what.joint == joint) return &change;
  }
  return nullptr;
}

TEST(LogChanges, WearToolAndTemperatureAreToldApartWithTheirLogs) {
  std::mt19937_64 random(11);
  const Robot robot = ArmWithFriction(3, &random);
  const SimulatedSeries simulated = SimulateSeries(
      robot, 14, {.03, .02},
      {{ChangedPart::kFriction, ChangeForm::kDrift, 1, 0, .9},
       {ChangedPart::kMass, ChangeForm::kStep, 2, 8, .06},
       {ChangedPart::kAllFriction, ChangeForm::kStep, -1, 5, .4}},
      &random);
  const LogChanges changes = FindLogChanges(robot, simulated.series);
  ASSERT_EQ(changes.changes.size(), 3u) << FullChanges(changes);
  const NamedChange* wear = Find(changes, ChangedPart::kFriction, 1);
  ASSERT_NE(wear, nullptr);
  EXPECT_EQ(wear->found.course.form, ChangeForm::kDrift);
  EXPECT_EQ(wear->reading, "wear");
  const NamedChange* tool = Find(changes, ChangedPart::kMass, 2);
  ASSERT_NE(tool, nullptr);
  EXPECT_EQ(tool->found.course.form, ChangeForm::kStep);
  EXPECT_EQ(tool->found.course.log, 8);
  EXPECT_EQ(tool->reading, "tool or load");
  const NamedChange* warmth = Find(changes, ChangedPart::kAllFriction, -1);
  ASSERT_NE(warmth, nullptr);
  EXPECT_EQ(warmth->found.course.log, 5);
  EXPECT_NEAR(warmth->value[0], .4, 3 * warmth->stddev[0]);
  EXPECT_LT(warmth->stddev[0], .12);
}

TEST(LogChanges, DaysAloneAreNoChange) {
  std::mt19937_64 random(12);
  const Robot robot = ArmWithFriction(3, &random);
  const SimulatedSeries simulated =
      SimulateSeries(robot, 14, {.08, .04}, {}, &random);
  const LogChanges changes = FindLogChanges(robot, simulated.series);
  EXPECT_TRUE(changes.changes.empty()) << FullChanges(changes);
  EXPECT_THAT(FullChanges(changes), HasSubstr("no step and no drift"));
  EXPECT_EQ(BriefChanges(changes), "");
  // 14 logs tell .08 to a fifth.
  EXPECT_GT(changes.viscous_scatter, .03);
  EXPECT_LT(changes.viscous_scatter, .15);
}

// Drag that no model has makes friction of fast logs larger than that of slow
// ones: in whatever order they come, no change of the robot is told.
void ExpectFasterIsNoChange(const Eigen::VectorXd& speed) {
  std::mt19937_64 random(14);
  const Robot robot = ArmWithFriction(2, &random);
  const SimulatedSeries simulated =
      SimulateSeries(robot, static_cast<int>(speed.size()), {.02, .02}, {},
                     &random, {speed, .5});
  const LogChanges changes = FindLogChanges(robot, simulated.series);
  EXPECT_TRUE(changes.changes.empty()) << FullChanges(changes);
  EXPECT_FALSE(changes.with_motion.empty());
}

TEST(LogChanges, FrictionOfFasterLogsIsNoChange) {
  const Eigen::VectorXd rising = Eigen::VectorXd::LinSpaced(12, .5, 2);
  ExpectFasterIsNoChange(rising);
  ExpectFasterIsNoChange(rising.reverse());
  Eigen::VectorXd mixed = rising;
  for (int l = 0; l < 12; ++l) mixed[l] = rising[5 * l % 12];
  ExpectFasterIsNoChange(mixed);
}

TEST(LogChanges, ReportsHaveWhatWasFound) {
  std::mt19937_64 random(13);
  const Robot robot = ArmWithFriction(2, &random);
  const SimulatedSeries simulated = SimulateSeries(
      robot, 10, {.01, .01},
      {{ChangedPart::kOffset, ChangeForm::kStep, 0, 4, .3}}, &random);
  const LogChanges changes = FindLogChanges(robot, simulated.series);
  ASSERT_EQ(changes.changes.size(), 1u) << FullChanges(changes);
  EXPECT_EQ(BriefChanges(changes),
            "From log to log: the offset of joint1 changed at log 5.");
  const nlohmann::json json = ToJson(changes);
  const nlohmann::json& change = json.at("changes").at(0);
  EXPECT_EQ(change.at("kind"), "step");
  EXPECT_EQ(change.at("part"), "offset");
  EXPECT_EQ(change.at("log"), 5);
  EXPECT_EQ(change.at("log_name"), "log5");
  EXPECT_EQ(change.at("joint_index"), 1);
  ASSERT_EQ(json.at("series").size(),
            static_cast<size_t>(simulated.series.parameters.size()));
  for (const nlohmann::json& parameter : json.at("series")) {
    EXPECT_EQ(parameter.at("value").size(), 10u);
    EXPECT_EQ(parameter.at("model").size(), 10u);
  }
}

}  // namespace armcal::changes_test
