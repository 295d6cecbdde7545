#include "calib/diagnose/changes/search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::search_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Logs that measure two parameters to .01 each; they scatter by .02.
struct Series {
  Series(int count, std::mt19937_64* random) : times(count) {
    for (int l = 0; l < count; ++l) {
      VectorXd y(2);
      for (double& v : y) v = .03 * Normal(random) / .01;
      logs.push_back({100 * MatrixXd::Identity(2, 2), y});
      times[l] = l;
    }
    for (int k = 0; k < 2; ++k) {
      components.push_back({VectorXd::Unit(2, k), .02});
      ChangeHypothesis one;
      for (const LogEquations& log : logs) {
        one.columns.push_back(log.root.col(k));
      }
      one.prior = VectorXd::Constant(1, .3);
      one.scatter = {k};
      one.share = .5;
      one.family = k;
      hypotheses.push_back(one);
    }
  }
  // Parameter k by `size` from `log` on, in one log or ever more.
  void Plant(int k, ChangeForm form, int log, double size) {
    const VectorXd course = CourseOf({form, log, 0}, times, {});
    for (size_t l = 0; l < logs.size(); ++l) {
      logs[l].right[k] += 100 * size * course[static_cast<Eigen::Index>(l)];
    }
  }
  SeriesChanges Find() const {
    return FindChanges(logs, components, hypotheses, times);
  }

  std::vector<LogEquations> logs;
  std::vector<ScatterComponent> components;
  std::vector<ChangeHypothesis> hypotheses;
  VectorXd times;
};

TEST(ChangeSearch, FindsStepAndDriftOfTwoParametersApart) {
  std::mt19937_64 random(1);
  Series series(16, &random);
  series.Plant(0, ChangeForm::kStep, 9, .2);
  series.Plant(1, ChangeForm::kDrift, 0, -.4);
  const SeriesChanges found = series.Find();
  ASSERT_EQ(found.changes.size(), 2u);
  const FoundChange& drift = found.changes[0];
  EXPECT_EQ(drift.hypothesis, 1);
  EXPECT_EQ(drift.course.form, ChangeForm::kDrift);
  EXPECT_NEAR(drift.value[0], -.4, 3 * std::sqrt(drift.covariance(0, 0)));
  const FoundChange& step = found.changes[1];
  EXPECT_EQ(step.hypothesis, 0);
  EXPECT_EQ(step.course.form, ChangeForm::kStep);
  EXPECT_EQ(step.course.log, 9);
  EXPECT_EQ(step.logs, std::vector<int>({9}));
  EXPECT_GT(step.probability, .99);
  // .03 / sqrt of 7 and of 9 logs.
  const double stddev = .03 * std::sqrt(1. / 7 + 1. / 9);
  EXPECT_NEAR(step.value[0], .2, 3 * stddev);
  EXPECT_NEAR(std::sqrt(step.covariance(0, 0)), stddev, .4 * stddev);
}

TEST(ChangeSearch, OneLogIsNoStep) {
  std::mt19937_64 random(2);
  Series series(12, &random);
  series.Plant(0, ChangeForm::kOnce, 5, .5);
  const SeriesChanges found = series.Find();
  ASSERT_EQ(found.changes.size(), 1u);
  EXPECT_EQ(found.changes[0].course.form, ChangeForm::kOnce);
  EXPECT_EQ(found.changes[0].course.log, 5);
}

// Of four logs two and two that differ by several standard deviations of what
// each log knows may be days: nothing is claimed. Clear of any usual scatter
// it is.
TEST(ChangeSearch, FewLogsHaveToBeatWhatDaysMayDo) {
  const auto claims = [](double size) {
    std::mt19937_64 random(3);
    Series series(4, &random);
    series.Plant(0, ChangeForm::kStep, 2, size);
    return series.Find().changes.size();
  };
  EXPECT_EQ(claims(.08), 0u);
  EXPECT_EQ(claims(.8), 1u);
}

TEST(ChangeSearch, NothingIsFoundWhereNothingChanges) {
  std::mt19937_64 random(4);
  int claims = 0;
  for (int k = 0; k < 200; ++k) {
    claims += static_cast<int>(Series(12, &random).Find().changes.size());
  }
  EXPECT_LE(claims, 3);  // 1 % of series, P(X > 3) is 14 %; none is usual
}

}  // namespace armcal::search_test
