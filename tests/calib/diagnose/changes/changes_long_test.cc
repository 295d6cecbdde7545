#include <gtest/gtest.h>

#include <cstdio>

#include "calib/diagnose/changes/changes.h"
#include "calib/diagnose/changes/report.h"
#include "tests/fixtures/log_series.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::changes_long_test {

constexpr int kLogs = 20;

DayToDay DrawDays(std::mt19937_64* random) {
  return {Uniform(random, 0, .08), Uniform(random, .005, .05)};
}

// Two steps and a drift, each of another part or joint: friction of all joints
// (30 to 60 %), of one (40 to 100 %), an offset (10 to 30 % of the joint's
// torque), a tool (3 to 10 % of the arm's mass).
std::vector<PlantedChange> DrawChanges(int joints, std::mt19937_64* random) {
  const ChangedPart parts[] = {ChangedPart::kAllFriction,
                               ChangedPart::kFriction, ChangedPart::kMass,
                               ChangedPart::kFriction, ChangedPart::kOffset};
  std::vector<PlantedChange> planted;
  while (planted.size() < 3) {
    PlantedChange c;
    c.part = parts[(*random)() % 5];
    c.form = planted.size() < 2 ? ChangeForm::kStep : ChangeForm::kDrift;
    c.log = c.form == ChangeForm::kStep
                ? 2 + static_cast<int>((*random)() % (kLogs - 3))
                : 0;
    const bool mass = c.part == ChangedPart::kMass;
    c.joint = c.part == ChangedPart::kAllFriction ? -1
              : mass                              ? joints - 1
                     : static_cast<int>((*random)() % joints);
    c.size = c.part == ChangedPart::kAllFriction ? Uniform(random, .3, .6)
             : c.part == ChangedPart::kFriction  ? Uniform(random, .4, 1)
             : mass                              ? Uniform(random, .03, .1)
                                                 : Uniform(random, .1, .3);
    bool again = mass && c.form == ChangeForm::kDrift;
    for (const PlantedChange& other : planted) {
      again = again || c.log == other.log ||
              (c.part == other.part && c.joint == other.joint);
    }
    if (!again) planted.push_back(c);
  }
  return planted;
}

bool Matches(const NamedChange& change, const PlantedChange& planted) {
  const bool same = change.what.part == planted.part &&
                    change.what.joint == planted.joint &&
                    change.found.course.form == planted.form;
  return same && (planted.form == ChangeForm::kDrift ||
                  change.found.course.log == planted.log);
}

struct Score {
  int planted = 0, found = 0, claims = 0, wrong = 0, single = 0;
};

void Add(const LogChanges& changes, const std::vector<PlantedChange>& planted,
         int seed, Score* score) {
  int found = 0;
  for (const PlantedChange& one : planted) {
    for (const NamedChange& change : changes.changes) {
      if (!Matches(change, one)) continue;
      ++found;
      break;
    }
  }
  const int claims = static_cast<int>(changes.changes.size());
  score->planted += static_cast<int>(planted.size());
  score->found += found;
  score->claims += claims;
  score->wrong += claims - found;
  score->single += static_cast<int>(changes.single_logs.size());
  if (found == static_cast<int>(planted.size()) && claims == found) return;
  std::printf("seed %d:\n%s", seed, FullChanges(changes).c_str());
  for (const PlantedChange& one : planted) {
    std::printf("  planted %s %s %d, log %d, %.2f\n", ChangeFormName(one.form),
                ChangedPartName(one.part), one.joint + 1, one.log + 1,
                one.size);
  }
}

Score RunBench(int first_seed, int series, bool with_changes) {
  Score score;
  for (int seed = first_seed; seed < first_seed + series; ++seed) {
    std::mt19937_64 random(seed);
    const int joints = 2 + seed % 5;
    const Robot robot = ArmWithFriction(joints, &random);
    const DayToDay days = DrawDays(&random);
    std::vector<PlantedChange> planted;
    if (with_changes) planted = DrawChanges(joints, &random);
    const SimulatedSeries simulated =
        SimulateSeries(robot, kLogs, days, planted, &random);
    Add(FindLogChanges(robot, simulated.series), planted, seed, &score);
  }
  std::printf(
      "%d series: %d of %d found with the right log, %d of %d claims wrong, "
      "%d single logs\n",
      series, score.found, score.planted, score.wrong, score.claims,
      score.single);
  return score;
}

// What the issue asks for. Seeds that nothing was tuned on.
TEST(LogChangesBench, PlantedChangesAreFoundWithTheRightLog) {
  const Score score = RunBench(7000, 60, true);
  EXPECT_GE(score.found, .95 * score.planted);
  EXPECT_LE(score.wrong, .05 * score.claims);
}

TEST(LogChangesBench, NothingIsClaimedOfDaysAlone) {
  const Score score = RunBench(8000, 200, false);
  EXPECT_LE(score.wrong, 2);  // 1 %
}

}  // namespace armcal::changes_long_test
