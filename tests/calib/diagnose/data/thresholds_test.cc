#include "calib/diagnose/data/thresholds.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <stdexcept>

namespace armcal::thresholds_test {

// Whoever adds one to the struct is reminded of the list.
TEST(Thresholds, AreAllListedOnce) {
  EXPECT_EQ(ListThresholds().size(), sizeof(Thresholds) / sizeof(double));
  std::set<std::string> names;
  for (const ThresholdInfo& info : ListThresholds()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
  }
}

TEST(Thresholds, HaveUnitMeaningAndSource) {
  for (const ThresholdInfo& info : ListThresholds()) {
    EXPECT_GT(Limits().*info.value, 0) << info.name;
    for (const char* text : {info.unit, info.meaning, info.source}) {
      EXPECT_GT(std::strlen(text), 0u) << info.name;
    }
  }
}

TEST(Thresholds, AreSetByName) {
  const double score = Limits().score, left = Limits().left;
  SetThresholds("score=24,left=.15");
  EXPECT_EQ(Limits().score, 24);
  EXPECT_EQ(Limits().left, .15);
  SetThresholds("score=" + std::to_string(score) +
                ",left=" + std::to_string(left));
  SetThresholds("");
  EXPECT_EQ(Limits().score, score);
}

TEST(Thresholds, RefuseWhatIsNone) {
  for (const char* text : {"scores=1", "score", "score=", "score=0", "score=-1",
                           "score=1e999", "score=nan", "score=12x"}) {
    EXPECT_THROW(SetThresholds(text), std::invalid_argument) << text;
  }
  EXPECT_EQ(Limits().score, 12);
}

}  // namespace armcal::thresholds_test
