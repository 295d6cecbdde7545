#include "calib/excite/posture_design.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fixtures/sample_robots.h"

namespace armcal::posture_design_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class PostureDesignTest : public testing::TestWithParam<const char*> {
 protected:
  PostureDesignTest() : robot_(SampleRobot(GetParam())) {
    const int n = robot_.num_joints();
    options_.lower = VectorXd::Constant(n, -2.5);
    options_.upper = VectorXd::Constant(n, 2.5);
    options_.noise = {1e-4, 1e-4};
  }

  // The median criterion of `draws` sets of `count` random postures.
  double OfRandomOnes(int count, int draws) const {
    std::mt19937_64 random(11);
    const int n = robot_.num_joints();
    std::vector<double> values;
    for (int k = 0; k < draws; ++k) {
      const MatrixXd q =
          UniformVector(&random, count * n, -2.5, 2.5).reshaped(count, n);
      values.push_back(PostureCriterion(robot_, options_, q));
    }
    std::nth_element(values.begin(), values.begin() + draws / 2, values.end());
    return values[draws / 2];
  }

  Robot robot_;
  PostureOptions options_;
};

TEST_P(PostureDesignTest, TwentyAreAsGoodAsMoreRandomOnes) {
  for (const auto instrument :
       {PoseInstrument::kTarget, PoseInstrument::kPose}) {
    options_.instrument = instrument;
    for (const auto criterion :
         {ExcitationCriterion::kA, ExcitationCriterion::kWorst}) {
      options_.criterion = criterion;
      const PostureDesign design = DesignPostures(robot_, options_);
      EXPECT_LT(design.criterion, OfRandomOnes(25, 15));
      EXPECT_NEAR(design.criterion,
                  PostureCriterion(robot_, options_, design.q), 1e-6);
    }
  }
}

TEST_P(PostureDesignTest, WithinTheLimitsAndTheSameAgain) {
  options_.count = 12;
  const PostureDesign design = DesignPostures(robot_, options_);
  ASSERT_EQ(design.q.rows(), 12);
  EXPECT_LE(design.q.cwiseAbs().maxCoeff(), 2.5);
  EXPECT_EQ(design.q, DesignPostures(robot_, options_).q);
  EXPECT_EQ(design.names.size(), static_cast<size_t>(design.stddev.size()));
  EXPECT_LT(design.stddev.norm(), design.random_stddev.norm());
}

INSTANTIATE_TEST_SUITE_P(Arms, PostureDesignTest,
                         testing::Values("UR5 6R", "PUMA560 6R", "Panda 7R"));

}  // namespace armcal::posture_design_test
