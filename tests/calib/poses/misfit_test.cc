#include "calib/poses/misfit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calib/poses/calibrate_poses.h"
#include "calib/poses/verdict.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::misfit_test {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

struct Outcome {
  PoseCalibration calibration;
  std::vector<std::string> shortcomings;
};

Outcome Calibrate(const Plant& plant, const PoseMeasurements& m) {
  PoseCalibrationOptions options;
  options.folds = 0;
  const auto c = CalibratePoses(plant.nominal, m, options);
  return {c, Shortcomings(plant.nominal, c)};
}

// An instrument that is as good as stated, of one uncertainty for all poses or
// of one that differs, and one that is said to be ten times better.
TEST(PoseMisfit, IsJudgedByTheInstrument) {
  for (const auto instrument :
       {Instrument::kTargets, Instrument::kPoses, Instrument::kWire}) {
    Plant plant("PUMA560 6R", 9);
    auto m = plant.Measure(instrument, 120, kNoise);
    EXPECT_TRUE(
        std::isnan(Calibrate(plant, m).calibration.misfit.instrument_ratio));
    m.u95 = Eigen::MatrixXd::Constant(120, 1, 1.96 * kNoise);
    const Outcome good = Calibrate(plant, m);
    EXPECT_NEAR(good.calibration.misfit.instrument_ratio, 1, .2);
    EXPECT_THAT(good.shortcomings, IsEmpty());
    m.u95 /= 10;
    const Outcome bad = Calibrate(plant, m);
    EXPECT_NEAR(bad.calibration.misfit.instrument_ratio, 10, 2);
    EXPECT_THAT(bad.shortcomings, Contains(HasSubstr("beside an instrument")));
    m.u95.setZero();  // not stated
    EXPECT_THAT(Calibrate(plant, m).shortcomings, IsEmpty());
  }
}

// A reflector that slips by a millimetre after half of the poses.
TEST(PoseMisfit, TellsWhatDependsOnTheOrder) {
  Plant plant("UR5 6R", 4);
  auto m = plant.Measure(Instrument::kTargets, 80, kNoise);
  EXPECT_EQ(OrderSentence(Calibrate(plant, m).calibration.misfit), "");
  for (auto& target : m.targets) {
    target.bottomRows(40).col(2).array() += 1e-3;
  }
  PoseCalibrationOptions options;
  options.loss = RobustLoss::kSquared;
  const auto c = CalibratePoses(plant.nominal, m, options);
  EXPECT_GT(c.misfit.order_correlation, .5);
  EXPECT_THAT(OrderSentence(c.misfit), HasSubstr("of successive poses"));
}

TEST(PoseMisfit, GivesUpGrossErrorsButNotMore) {
  Plant plant("PUMA560 6R", 12);
  const auto m = plant.Measure(Instrument::kTargets, 100, kNoise);
  const auto spoilt = [&](int poses) {
    auto wrong = m;
    for (int k = 0; k < poses; ++k) {
      for (auto& target : wrong.targets) {
        target.row(5 * k) += .05 * Eigen::RowVector3d::Unit(k % 3);
      }
    }
    return Calibrate(plant, wrong);
  };
  EXPECT_THAT(spoilt(5).shortcomings, IsEmpty());
  const Outcome many = spoilt(18);
  EXPECT_EQ(many.calibration.outliers.size(), 18);
  EXPECT_THAT(many.shortcomings,
              Contains(HasSubstr("18 of 100 poses are outliers")));
}

// By hand: joint 1 at 0 1 2 3 has 5 about its mean, 0 1 2 of them 2; joint 2
// moves in the last pose alone; joint 3 never does.
TEST(PoseMisfit, SharesMotionBySquares) {
  Eigen::MatrixXd q(4, 3);
  q << 0, 1, 5, 1, 1, 5, 2, 1, 5, 3, 4, 5;
  const Eigen::VectorXd share = MotionShare(q, {0, 1, 2});
  EXPECT_NEAR(share[0], .4, 1e-12);
  EXPECT_NEAR(share[1], 0, 1e-12);
  EXPECT_EQ(share[2], 1);
  EXPECT_TRUE(MotionShare(q, {}).isZero());
}

}  // namespace armcal::misfit_test
