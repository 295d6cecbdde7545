#include <gtest/gtest.h>

#include "tests/blind/blind_score.h"
#include "tests/blind/true_share.h"

namespace armcal::score_test {

using Effect = BlindLabel::Effect;
using Named = BlindAnswer::Effect;

Effect True(const std::string& effect, int joint, double enr, double size = 2) {
  return {{effect, joint}, true, enr, {{"friction", "N m", size}}, ""};
}

BlindLabel Label(const std::vector<Effect>& effects,
                 const std::string& excitation = "rich") {
  BlindLabel label;
  label.arm = "elbow";
  label.excitation = excitation;
  label.effects = effects;
  return label;
}

Named Claim(const std::string& effect, int joint, double probability,
            double size = 2) {
  return {{effect, joint}, probability, {{"friction", "N m", size}}, {}};
}

BlindAnswer Answer(const std::string& verdict,
                   const std::vector<Named>& effects = {}) {
  BlindAnswer answer;
  answer.verdict = verdict;
  answer.effects = effects;
  for (const Named& effect : effects) {
    answer.candidates.push_back(effect.placed);
  }
  return answer;
}

// Hits and count of a cell.
std::pair<int, int> Cell(const ScoreTable& table, const std::string& row,
                         const std::string& column) {
  const ScoreTable::Cell cell = table.At(row, column);
  return {cell.hits, cell.count};
}
using Counts = std::pair<int, int>;

TEST(BlindScore, FalseAlarms) {
  BlindScore score;
  const auto add = [&score](const std::string& excitation,
                            const BlindAnswer& answer) {
    score.Add(CaseScore(Label({}, excitation), answer, {}));
  };
  add("rich", Answer("noise_floor"));
  add("rich", Answer("absorbed"));
  add("rich", Answer("not_testable"));
  add("rich", Answer("unknown"));
  add("rich", Answer("explained", {Claim("spring", 1, .9)}));
  add("slow", Answer("noise_floor"));
  add("slow", BlindAnswer());
  EXPECT_EQ(Cell(score.none(), "rich", "false alarm"), Counts(2, 5));
  EXPECT_EQ(Cell(score.none(), "rich", "confident wrong name"), Counts(1, 5));
  EXPECT_EQ(Cell(score.none(), "poor", "false alarm"), Counts(1, 2));
  EXPECT_EQ(Cell(score.none(), "poor, slow", "no answer"), Counts(1, 2));
}

TEST(BlindScore, OneEffect) {
  Equivalents equivalents;
  equivalents.Add("elbow", {"cable", 1}, {"spring", 1}, .97);
  BlindScore score;
  const auto add = [&](double enr, const BlindAnswer& answer) {
    score.Add(CaseScore(Label({True("spring", 1, enr)}), answer, equivalents));
  };
  add(.5, Answer("explained", {Claim("spring", 1, .95)}));
  add(.5, Answer("explained", {Claim("cable", 1, .9)}));  // equivalent
  add(.5, Answer("explained", {Claim("cable", 2, .9)}));  // wrong joint
  Named stribeck = Claim("stribeck", 1, .5);  // wrong effect, and knows it
  stribeck.equivalent = {{"spring", 1}};
  add(.5, Answer("explained", {stribeck}));
  add(.5, Answer("unknown"));
  add(.5, Answer("absorbed"));
  add(.5,
      Answer("explained", {Claim("spring", 1, .9), Claim("backlash", 2, .9)}));
  add(.2, Answer("noise_floor"));
  const ScoreTable& one = score.one();
  EXPECT_EQ(Cell(one, "rich 0.32-1", "detected"), Counts(6, 7));
  EXPECT_EQ(Cell(one, "rich 0.32-1", "class and joint"), Counts(3, 7));
  EXPECT_EQ(Cell(one, "rich 0.32-1", "  of these an equivalent"), Counts(1, 7));
  EXPECT_EQ(Cell(one, "rich 0.32-1", "or by its own equivalents"),
            Counts(4, 7));
  EXPECT_EQ(Cell(one, "rich 0.32-1", "joint"), Counts(4, 7));
  EXPECT_EQ(Cell(one, "rich 0.32-1", "exactly that"), Counts(2, 7));
  EXPECT_EQ(Cell(one, "rich 0.32-1", "confident wrong name"), Counts(2, 7));
  EXPECT_EQ(Cell(one, "all >= 0.32", "joint"), Counts(4, 7));
  EXPECT_EQ(Cell(one, "rich 0.17-0.32", "detected"), Counts(0, 1));
  EXPECT_EQ(Cell(one, "rich 0.32-1", "candidate set holds truth"),
            Counts(3, 5));
  EXPECT_EQ(one.At("rich 0.32-1", "size of candidate set").values,
            (std::vector<double>{1, 1, 1, 1, 2}));
  EXPECT_EQ(Cell(score.by_effect(), "spring", ">= 0.32"), Counts(3, 7));
  const auto confusion = score.Json()["confusion"]["spring"];
  EXPECT_EQ(confusion["cable"], 2);
  EXPECT_EQ(confusion["absorbed"], 1);
  EXPECT_EQ(score.Json()["faults"].size(), 6u);
}

TEST(BlindScore, TwoEffects) {
  BlindScore score;
  const auto add = [&score](const BlindAnswer& answer) {
    score.Add(CaseScore(Label({True("spring", 1, .5), True("stribeck", 2, .4)}),
                        answer, {}));
  };
  const Named spring = Claim("spring", 1, .9),
              stribeck = Claim("stribeck", 2, .9);
  add(Answer("explained", {stribeck, spring}));
  add(Answer("explained", {spring, stribeck, Claim("cable", 3, .5)}));
  add(Answer("partly_explained", {spring}));
  add(Answer("partly_explained", {Claim("cable", 3, .5), spring}));
  const ScoreTable& two = score.two();
  EXPECT_EQ(Cell(two, "both >= 0.32", "both found"), Counts(2, 4));
  EXPECT_EQ(Cell(two, "both >= 0.32", "exactly these"), Counts(1, 4));
  EXPECT_EQ(Cell(two, "both >= 0.32", "strongest claim right"), Counts(3, 4));
  EXPECT_EQ(Cell(two, "both >= 0.32", "one found"), Counts(4, 4));
}

TEST(BlindScore, OutOfCatalogue) {
  Equivalents equivalents;
  equivalents.Add("elbow", {"slosh", 0}, {"payload", 0}, .99);
  BlindScore score;
  const auto add = [&](const BlindAnswer& answer) {
    Effect slosh = True("slosh", 0, .5);
    slosh.in_catalogue = false;
    score.Add(CaseScore(Label({slosh}), answer, equivalents));
  };
  add(Answer("unknown"));
  add(Answer("explained", {Claim("payload", 0, .95)}));         // equivalent
  add(Answer("partly_explained", {Claim("armature", 3, .6)}));  // not confident
  add(Answer("explained", {Claim("armature", 3, .8)}));
  add(BlindAnswer());
  const ScoreTable& outside = score.outside();
  EXPECT_EQ(Cell(outside, "all >= 0.32", "abstains or equivalent"),
            Counts(3, 5));
  EXPECT_EQ(Cell(outside, "all >= 0.32", "confident wrong name"), Counts(1, 5));
  EXPECT_EQ(Cell(outside, "slosh", "any wrong name"), Counts(2, 5));
  EXPECT_EQ(Cell(outside, "slosh", "detected"), Counts(4, 5));
}

TEST(BlindScore, SizesOfWhatIsNamedRightly) {
  BlindScore score;
  const auto add = [&score](const Named& claim) {
    score.Add(CaseScore(Label({True("spring", 1, .5, 2)}),
                        Answer("explained", {claim}), {}));
  };
  add(Claim("spring", 1, .9, 2.2));
  add(Claim("spring", 1, .9, 1.4));
  add(Claim("spring", 2, .9, 9));  // another joint's
  Named other_unit = Claim("spring", 1, .9, 9);
  other_unit.estimates[0].unit = "N";
  add(other_unit);
  const auto errors = score.sizes().At("spring", "error").values;
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NEAR(errors[0], .1, 1e-12);
  EXPECT_NEAR(errors[1], .3, 1e-12);
  EXPECT_EQ(Cell(score.sizes(), "spring", "found, with a size"), Counts(2, 3));
}

// Torque F and ratio r on joint 2 are r F and 1 / r on joint 3.
TEST(CaseScore, FrictionOfTwoJointsHasTwoSides) {
  Effect truth = True("coupled_friction", 2, .5);
  truth.values.push_back({"neighbour", "1", 3});
  const auto top = [&](int joint, int neighbour) {
    Named claim = Claim("coupled_friction", joint, .9);
    claim.estimates.push_back(
        {"neighbour", "1", static_cast<double>(neighbour)});
    return CaseScore(Label({truth}), Answer("explained", {claim}), {}).top();
  };
  EXPECT_EQ(top(2, 3), Match::kRight);
  EXPECT_EQ(top(3, 2), Match::kRight);
  EXPECT_EQ(top(3, 4), Match::kWrong);
  EXPECT_EQ(top(1, 2), Match::kWrong);
}

TEST(BlindScore, RemovedShare) {
  BlindScore score;
  const auto add = [&score](double removable, std::optional<double> removed) {
    BlindLabel label = Label({True("spring", 1, .5)});
    label.oracle_removed_percent = 80;
    label.removable = removable;
    BlindAnswer answer = Answer("explained", {Claim("spring", 1, .9)});
    answer.torque.removed_percent = removed;
    answer.torque.low = 70;
    answer.torque.high = removed;
    answer.torque.true_removed_percent = 80;
    score.Add(CaseScore(label, answer, {}));
  };
  add(1, 76);
  add(1, 84);
  add(1, std::nullopt);
  add(.1, 10);  // nothing to remove
  const ScoreTable& removed_share = score.removed_share();
  EXPECT_EQ(removed_share.At("torque", "removed, % (0 where not told)").values,
            (std::vector<double>{76, 84, 0}));
  EXPECT_EQ(removed_share.At("torque", "share of the oracle's").values,
            (std::vector<double>{.95, 1.05, 0}));
  // 80 is not in 70 to 76, but in 70 to 84 and above 70.
  EXPECT_EQ(
      Cell(removed_share, "torque", "interval holds what is truly removed"),
      Counts(2, 3));
  EXPECT_EQ(Cell(removed_share, "torque", "interval is open"), Counts(1, 3));
  EXPECT_EQ(
      removed_share.At("torque", "truly removed, share of the oracle's").values,
      (std::vector<double>{1, 1, 1}));
}

TEST(TrueShare, IsOfTheSameClaimsOnMotionWithoutNoise) {
  BlindAnswer answer =
      Answer("explained", {Claim("spring", 1, .9), Claim("cable", 2, .6)});
  BlindAnswer quiet =
      Answer("explained", {Claim("cable", 2, .7), Claim("spring", 1, .8)});
  quiet.torque.refit = 4;
  quiet.torque.after = 1;
  EXPECT_EQ(TrueRemovedPercent(answer, quiet), 75);
  quiet.effects.pop_back();
  EXPECT_EQ(TrueRemovedPercent(answer, quiet), std::nullopt);
  EXPECT_EQ(TrueRemovedPercent(answer, BlindAnswer()), std::nullopt);
}

}  // namespace armcal::score_test
