#include "calib/diagnose/select/redundant.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "calib/diagnose/select/form_error.h"
#include "tests/fixtures/sample_motion.h"

namespace armcal::redundant_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRows = 1000;

// Two effects of one column each on one joint, 3 and 1 of which the torque is;
// the second is of a law that bends.
class FindHollowTest : public testing::Test {
 protected:
  FindHollowTest() : effects_(2), candidates_(2) {
    std::mt19937_64 random(7);
    const auto noise = [&random] {
      return VectorXd(
          VectorXd::NullaryExpr(kRows, [&] { return Normal(&random); }));
    };
    effects_[1].larger_sizes = {10};
    const VectorXd a = noise(), b = noise();
    const MatrixXd baseline = MatrixXd::Constant(kRows, 1, 1e-3);
    screen_ = std::make_unique<GapScreen>(OnEachJoint({baseline}), 1,
                                          JointRows{3 * a + b + noise()});
    for (int k = 0; k < 2; ++k) {
      effects_[k].parameters.resize(1);
      candidates_[k].effect = &effects_[k];
      candidates_[k].joint = 0;
      candidates_[k].linear = {0};
      candidates_[k].columns = {k};
      screen_->AddColumn({k == 0 ? a : b});
    }
    screen_->Factor();
    selection_.chosen = {0, 1};
  }
  // The place of what fitted laws that explain this share of what the columns
  // do have for nothing.
  int HollowAt(double share) const {
    RefinedEffects refined;
    refined.delta_chi2 =
        share * TotalDeltaChi2(*screen_, candidates_, selection_.chosen);
    return FindHollow(*screen_, candidates_, selection_, refined,
                      [this](size_t k) { return fitted_without_[k]; });
  }

  std::vector<Effect> effects_;
  std::vector<GapCandidate> candidates_;
  std::unique_ptr<GapScreen> screen_;
  Selection selection_;
  double fitted_without_[2] = {0, 0};  // of one by itself, the other left out
};

TEST_F(FindHollowTest, IsNoneWhereLawsKeepWhatTheirColumnsPromise) {
  EXPECT_EQ(HollowAt(1), -1);
  EXPECT_EQ(HollowAt(.95), -1);
}

TEST_F(FindHollowTest, IsWhatFitsByItsColumnOnly) {
  EXPECT_EQ(HollowAt(.85), 1);
  EXPECT_EQ(HollowAt(-1), 1);
}

// Both bend, and spoil the fit of both together: the one that is worth more by
// itself stays, whatever its column promises.
TEST_F(FindHollowTest, OfSeveralIsTheOneThatTheOthersDoWithout) {
  effects_[0].larger_sizes = {10};
  fitted_without_[0] = 900;
  fitted_without_[1] = 500;
  EXPECT_EQ(HollowAt(-1), 0);
  std::swap(fitted_without_[0], fitted_without_[1]);
  EXPECT_EQ(HollowAt(-1), 1);
}

// What is in proportion to its size has no other course when it is fitted.
TEST_F(FindHollowTest, IsOfALawThatBends) {
  effects_[1].larger_sizes = {};
  EXPECT_EQ(HollowAt(-1), -1);
}

}  // namespace armcal::redundant_test
