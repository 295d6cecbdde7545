#include <gtest/gtest.h>

#include <cmath>

#include "calib/numerics/median.h"
#include "model/text/input_error.h"
#include "tests/blind/binomial_interval.h"
#include "tests/blind/blind_label.h"
#include "tests/blind/score_table.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::figures_test {

// Published: no event in 30 has the upper bound 1 - 0.025^(1/30) = 11.57 %
// (the "rule of three" exactly); 81 of 263 has [25.27 %, 36.77 %] (Newcombe,
// Statistics in Medicine 17, 1998, table I, method 5), 15 of 148
// [5.78 %, 16.17 %], 1 of 29 [0.09 %, 17.76 %].
TEST(ClopperPearson, AsPublished) {
  EXPECT_EQ(ClopperPearson(0, 30).low, 0);
  EXPECT_NEAR(ClopperPearson(0, 30).high, 1 - std::pow(.025, 1. / 30), 1e-9);
  EXPECT_NEAR(ClopperPearson(81, 263).low, .2527, 5e-5);
  EXPECT_NEAR(ClopperPearson(81, 263).high, .3676, 5e-5);
  EXPECT_NEAR(ClopperPearson(15, 148).low, .0578, 5e-5);
  EXPECT_NEAR(ClopperPearson(15, 148).high, .1617, 5e-5);
  EXPECT_NEAR(ClopperPearson(1, 29).low, .0009, 5e-5);
  EXPECT_NEAR(ClopperPearson(1, 29).high, .1776, 5e-5);
  EXPECT_EQ(ClopperPearson(5, 5).high, 1);
}

TEST(Quantile, IsLinearBetweenNeighbours) {
  EXPECT_DOUBLE_EQ(Quantile({3, 1, 2}, .5), 2);
  EXPECT_DOUBLE_EQ(Quantile({1, 2, 3, 4}, .5), 2.5);
  EXPECT_DOUBLE_EQ(Quantile({0, 10}, .9), 9);
}

// Bins 0.5-0.6 (one right of two: |1.1 - 1|) and 0.9-1 (one of one: |0.9 - 1|).
TEST(Reliability, ComparesMeansBinByBin) {
  Reliability reliability;
  reliability.Add(.55, true);
  reliability.Add(.55, false);
  reliability.Add(.9, true);
  EXPECT_NEAR(reliability.ExpectedCalibrationError(), (.1 + .1) / 3, 1e-12);
  EXPECT_EQ(Reliability().ExpectedCalibrationError(), 0);
}

TEST(BlindAnswer, AsDesignHasIt) {
  const std::string path = WriteFile(R"({"verdict": "explained", "effects": [
    {"effect": "payload", "joint": "", "joint_index": 0, "probability": 0.9,
     "estimates": [{"name": "mass", "unit": "kg", "value": 1.5, "stddev": 0.1}],
     "equivalent": [{"effect": "link_inertia", "joint_index": 6}],
     "removed_percent": 90, "ci95": [80, 95]}],
    "candidates": [{"effect": "payload", "joint_index": 0, "probability": 0.9}],
    "gap": {"torque": {"removed_percent": 90, "ci95": [null, 95]},
            "forward": {"removed_percent": null}}})",
                                     "diagnosis.json");
  const BlindAnswer answer = ReadBlindAnswer(path);
  EXPECT_EQ(answer.verdict, "explained");
  ASSERT_EQ(answer.effects.size(), 1u);
  EXPECT_EQ(answer.effects[0].placed.Text(), "payload");
  EXPECT_EQ(answer.effects[0].estimates[0].value, 1.5);
  EXPECT_EQ(answer.effects[0].equivalent[0].Text(), "link_inertia@6");
  EXPECT_EQ(answer.candidates.size(), 1u);
  EXPECT_EQ(answer.torque.removed_percent, 90);
  EXPECT_FALSE(answer.torque.low || answer.forward.removed_percent);
  EXPECT_EQ(ReadBlindAnswer(path + ".none").verdict, "");
}

// A label as write_blind_cases leaves it: (4 / 2 + 0 / 1) / 2 floors to remove.
TEST(BlindLabel, AsWritten) {
  const std::string path = WriteFile(R"({"stratum": "one", "arm": "elbow",
    "excitation": "slow", "effects": [{"effect": "stribeck", "joint": "joint2",
      "joint_index": 2, "in_catalogue": true, "enr": 0.7, "size_limit": "",
      "values": [{"name": "stribeck", "unit": "N m", "value": 0.3}]}],
    "oracle": {"nominal": [9, 9], "refit": [5, 8], "after": [1, 8],
      "floor": [2, 1], "removed_percent": 60}})",
                                     "case_0042.json");
  const BlindLabel label = ReadBlindLabel(path);
  EXPECT_FALSE(label.rich());
  EXPECT_EQ(label.effects[0].placed.Text(), "stribeck@2");
  EXPECT_EQ(label.least_enr(), .7);
  EXPECT_EQ(label.oracle_removed_percent, 60);
  EXPECT_EQ(label.removable, 1);
  EXPECT_NE(
      MessageOf<InputError>(
          path, [&] { ReadBlindLabel(WriteFile("{}", "case_0042.json")); })
          .find("stratum"),
      std::string::npos);
}

}  // namespace armcal::figures_test
