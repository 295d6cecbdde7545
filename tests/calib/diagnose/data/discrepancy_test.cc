#include "calib/diagnose/data/discrepancy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/diagnose/data/baseline.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/segments.h"
#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::discrepancy_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class DiscrepancyTest : public DiagnosedArm<33> {
 protected:
  void SetUp() override {
    LogReaderOptions reader;
    reader.joint_names = File().JointNames();
    LogSet logs({Record(before_, "log.csv")}, reader, {});
    segments_ = ReadSegments(6, {}, logs);
    baseline_.emplace(File(), BaselineOptions(), UsualTorque(segments_));
    const GapRows rows(segments_, 6);
    torques_ = RecordedTorques(*baseline_, rows);
    scale_ = ScaleOf(*baseline_, rows, torques_);
  }

  std::vector<GapSegment> segments_;
  std::optional<GapBaseline> baseline_;
  std::vector<RecordedTorque> torques_;
  MotionScale scale_;
};

// All of it together is some per cent of a joint's usual torque, and half as
// much again of its friction: a robot is not worse known than that.
TEST_F(DiscrepancyTest, IsOfARoutineSize) {
  const Discrepancy discrepancy(File(), scale_, 1, .03);
  for (int j = 0; j < File().num_joints(); ++j) {
    const MatrixXd shapes = discrepancy.Torque(j, segments_[0], torques_[0]);
    const VectorXd spreads = discrepancy.Spreads(j, File().links[j].joint);
    ASSERT_EQ(shapes.cols(), spreads.size());
    const double variance =
        (shapes * spreads.asDiagonal()).squaredNorm() / shapes.rows();
    const double rms = std::sqrt(variance);
    EXPECT_GT(rms, .01 * scale_.torque[j]) << j;
    EXPECT_LT(rms, .06 * scale_.torque[j] + .2 * File().links[j].joint.coulomb)
        << j;
  }
}

// What one log's time says, says nothing of another.
TEST_F(DiscrepancyTest, EachLogDriftsForItself) {
  const Discrepancy discrepancy(File(), scale_, 2, .03);
  GapSegment other = segments_[0];
  other.log = 1;
  const MatrixXd first = discrepancy.Torque(0, segments_[0], torques_[0]);
  const MatrixXd second = discrepancy.Torque(0, other, torques_[0]);
  for (int k = 0; k < first.cols(); ++k) {
    if (discrepancy.IsOfTime(k)) {
      EXPECT_TRUE(first.col(k).isZero(0) || second.col(k).isZero(0)) << k;
    } else {
      EXPECT_EQ(first.col(k), second.col(k)) << k;
    }
  }
}

// Its columns are last, on their own joint alone, and can be left out again.
TEST_F(DiscrepancyTest, IsANuisanceOfTheBaseline) {
  const int before = baseline_->size();
  baseline_->AddDiscrepancy(Discrepancy(File(), scale_, 1, .03));
  EXPECT_EQ(baseline_->num_model_columns(), before);
  EXPECT_GT(baseline_->size(), before);
  EXPECT_EQ(baseline_->WithoutDiscrepancy().size(), before);
  const GapRows rows(segments_, 6);
  const auto columns = baseline_->ThinColumns(rows, torques_);
  for (int c = before; c < baseline_->size(); ++c) {
    int joints = 0;
    for (const BaselineColumns& own : columns)
      joints += own.Column(c).size() > 0;
    EXPECT_EQ(joints, 1) << c;
  }
  const Robot same = baseline_->With(VectorXd::Ones(baseline_->size()));
  const Robot model =
      baseline_->WithoutDiscrepancy().With(VectorXd::Ones(before));
  EXPECT_EQ(same.links[0].joint.viscous, model.links[0].joint.viscous);
}

}  // namespace armcal::discrepancy_test
