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

// At any one time it is as large as its shapes are on average, but for torque
// constants, which are no part of that.
TEST_F(DiscrepancyTest, DeviatesByWhatItsShapesAddUpTo) {
  const Discrepancy discrepancy(File(), scale_, 1, 0);
  const Discrepancy of_currents(File(), scale_, 1, .05);
  for (int j = 0; j < File().num_joints(); ++j) {
    const Joint& joint = File().links[j].joint;
    const MatrixXd shapes = discrepancy.Torque(j, segments_[0], torques_[0]);
    const double rms =
        (shapes * discrepancy.Spreads(j, joint).asDiagonal()).norm() /
        std::sqrt(static_cast<double>(shapes.rows()));
    const double deviation = discrepancy.Deviation(j, joint);
    EXPECT_GT(deviation, rms / 1.5) << j;
    EXPECT_LT(deviation, rms * 1.5) << j;
    EXPECT_EQ(of_currents.Deviation(j, joint), deviation) << j;
  }
  EXPECT_EQ(Discrepancy().Deviation(0, Joint()), 0);
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
