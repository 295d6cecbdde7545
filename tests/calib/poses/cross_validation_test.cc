// Which loss simulated poses are fitted by where the user names none.

#include "calib/poses/cross_validation.h"

#include <gtest/gtest.h>

#include "calib/numerics/median.h"
#include "tests/fixtures/sample_poses.h"

namespace armcal::pose_cross_validation_test {

constexpr int kPoses = 90;

PoseMeasurements Measured(Plant* plant) {
  return plant->Measure(Instrument::kTargets, kPoses, kNoise);
}

// Nothing is given up, and nothing else is tried.
TEST(PoseLoss, IsTukeysOfCleanPoses) {
  Plant plant("PUMA560 6R", 4);
  EXPECT_EQ(ChoosePoseLoss(plant.nominal, Measured(&plant), {}),
            RobustLoss::kTukey);
}

// Two poses of ninety are 2 cm off: nobody can predict them, and the others are
// predicted best by the loss that gives them up.
TEST(PoseLoss, IsTukeysOfPosesWithGrossErrors) {
  Plant plant("PUMA560 6R", 5);
  PoseMeasurements measured = Measured(&plant);
  for (auto& target : measured.targets) {
    target(11, 0) += .02;
    target(40, 2) -= .02;
  }
  EXPECT_EQ(ChoosePoseLoss(plant.nominal, measured, {}), RobustLoss::kTukey);
}

// Where the arm is stretched out far it sags, by more than all else that is
// left: given up, those poses would be predicted as if it did not.
TEST(PoseLoss, IsNoneThatGivesUpAPartOfTheWorkspace) {
  Plant plant("PUMA560 6R", 6);
  PoseMeasurements measured = Measured(&plant);
  for (auto& target : measured.targets) {
    const Eigen::VectorXd reach =
        (target.rowwise() - plant.X_WB.translation().transpose())
            .leftCols(2)
            .rowwise()
            .norm();
    const double far = Quantile({reach.begin(), reach.end()}, .8);
    for (int k = 0; k < target.rows(); ++k) {
      if (reach[k] > far) target(k, 2) -= .004;
    }
  }
  EXPECT_NE(ChoosePoseLoss(plant.nominal, measured, {}), RobustLoss::kTukey);
}

}  // namespace armcal::pose_cross_validation_test
