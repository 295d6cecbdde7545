#include "calib/drive_gains/drive_gains.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/drive_gains/report.h"
#include "tests/fixtures/drive_gain_runs.h"

namespace armcal::drive_gains_test {

using Eigen::VectorXd;
using testing::HasSubstr;

void ExpectGains(const DriveGains& result, const VectorXd& K, double relative) {
  ASSERT_TRUE(result.solved) << result.reason;
  for (int j = 0; j < K.size(); ++j) {
    EXPECT_NEAR(result.gains[j].value / K[j], 1, relative) << j;
    EXPECT_GT(result.gains[j].stddev, 0);
    EXPECT_NEAR(result.TorqueConstants()[j], K[j], relative * std::abs(K[j]));
  }
}

class Arms : public testing::TestWithParam<const char*> {};

// Without noise gains and centre of mass come out as they went in (the weak
// form's quadrature is good to 1e-5), whatever the robot file says of the
// links, and with drives that are wired the other way round.
TEST_P(Arms, ExactCurrentsGiveTheGains) {
  std::mt19937_64 random(7);
  DrivenArm driven = MakeDrivenArm(GetParam(), &random);
  driven.K[0] *= -1;
  const Currents currents(driven, 15, &random);
  Robot massless = SampleRobot(GetParam());
  for (const Robot& file : {driven.arm.file, massless}) {
    const DriveGains result =
        EstimateFromLogs(file, driven.payload.mass, {currents.bare},
                         {currents.loaded}, ExactOptions());
    ExpectGains(result, driven.K, 1e-4);
    const Eigen::Vector3d com =
        driven.payload.first_moment / driven.payload.mass;
    for (int k = 0; k < 3; ++k) {
      if (!result.com[k].identifiable) continue;
      EXPECT_NEAR(result.com[k].value, com[k], 1e-4) << k;
    }
    // Along a vertical last axis no height is ever felt.
    const bool vertical = std::string(GetParam()) == "SCARA RRPR";
    EXPECT_EQ(result.com[2].identifiable, !vertical);
    EXPECT_TRUE(result.com[0].identifiable && result.com[1].identifiable);
  }
}

INSTANTIATE_TEST_SUITE_P(, Arms,
                         testing::Values("3R elbow", "SCARA RRPR", "UR5 6R",
                                         "Panda 7R"));

TEST(DriveGains, UnitsAreThoseOfTheJoints) {
  std::mt19937_64 random(7);
  const DrivenArm driven = MakeDrivenArm("SCARA RRPR", &random);
  const Currents currents(driven, 15, &random);
  const DriveGains result = EstimateFromLogs(
      driven.arm.file, 3, {currents.bare}, {currents.loaded}, ExactOptions());
  EXPECT_EQ(result.gains[1].unit, "N m/A");
  EXPECT_EQ(result.gains[2].unit, "N/A");
}

// Of the least certain constant, with its joint, unless another was asked for.
TEST(DriveGains, ReportSaysWhatErrorIsAllowed) {
  DriveGains gains;
  gains.solved = true;
  gains.gains = {{"shoulder", "N m/A", 10, .1, true, ""},
                 {"wrist", "N m/A", -2, .478686, true, ""}};
  EXPECT_EQ(gains.LeastCertain(), 1);
  EXPECT_DOUBLE_EQ(gains.LargestRelativeStddev(), .239343);
  EXPECT_THAT(
      DriveGainsReport(gains),
      HasSubstr("allows each joint's torque an error of 23.9 %, that of the "
                "least certain constant (wrist); `torque_constants_stddev` "
                "says otherwise"));
  EXPECT_THAT(DriveGainsReport(gains, .05),
              HasSubstr("an error of 5 % (`torque_constants_stddev`)"));
  EXPECT_THAT(DriveGainsReport(gains, 0), HasSubstr("constants for exact"));
}

// A bare arm, and one whose mass is said to be another: the scale is the
// payload's and nothing else's.
TEST(DriveGains, ScaleIsThePayloads) {
  std::mt19937_64 random(8);
  const DrivenArm driven = MakeDrivenArm("3R elbow", &random);
  const Currents currents(driven, 15, &random);
  const DriveGains twice =
      EstimateFromLogs(driven.arm.file, 2 * driven.payload.mass,
                       {currents.bare}, {currents.loaded}, ExactOptions());
  ExpectGains(twice, 2 * driven.K, 1e-4);

  const DriveGains bare = EstimateFromLogs(
      driven.arm.file, 1, {currents.bare, currents.bare}, {}, ExactOptions());
  EXPECT_FALSE(bare.solved);
  EXPECT_THAT(bare.reason, HasSubstr("the torque scale is not observable"));
  EXPECT_THAT(bare.reason, HasSubstr("`payload_mass`"));
  for (const DriveGain& gain : bare.gains) {
    EXPECT_FALSE(gain.identifiable);
    EXPECT_TRUE(std::isnan(gain.value) && std::isinf(gain.stddev));
  }
  nlohmann::json json;
  AddDriveGains(bare, &json);
  EXPECT_TRUE(json["drive_gains"][0]["value"].is_null());
  EXPECT_FALSE(json["drive_gains"][0]["identifiable"]);
  EXPECT_TRUE(json["payload"]["com_x"].is_null());
  EXPECT_FALSE(json["termination"]["converged"]);
  EXPECT_THAT(DriveGainsReport(bare), HasSubstr("not calibrated: the torque"));
}

// Arms of all kinds, some of which do not show all their gains: what is
// reported is right.
TEST(DriveGains, OfRandomArmsAreRightOrRefused) {
  std::mt19937_64 random(20);
  int seen = 0;
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    SimulatedArm arm{RandomArm(4, &random), {}};
    SetRandomInertials(&random, &arm.file);
    arm.truth = arm.file;
    for (Link& link : arm.truth.links) link.joint.viscous = .5;
    const DrivenArm driven = Drive(arm, &random);
    Currents currents(driven, 15, &random);
    AddDriveNoise(.02, 1e-5, &random, &currents.bare);
    AddDriveNoise(.02, 1e-5, &random, &currents.loaded);
    const DriveGains result =
        EstimateFromLogs(arm.file, driven.payload.mass, {currents.bare},
                         {currents.loaded}, DriveOptions());
    for (int j = 0; j < 4; ++j) {
      const DriveGain& gain = result.gains[j];
      EXPECT_EQ(gain.identifiable, gain.reason.empty());
      if (!gain.identifiable) continue;
      ++seen;
      EXPECT_LT(std::abs(gain.value - driven.K[j]), 5 * gain.stddev) << j;
    }
  }
  EXPECT_GT(seen, 40);
}

// Disturbances of 50 standard deviations for 0.1 s, 1 % of the time: Huber's
// loss keeps the gains where intervals say, least squares does not.
TEST(DriveGains, DisturbancesDoNotPull) {
  std::mt19937_64 random(13);
  const DrivenArm driven = MakeDrivenArm("UR5 6R", &random);
  Currents currents(driven, 20, &random);
  for (Log* log : {&currents.bare, &currents.loaded}) {
    const VectorXd sigma = .02 * ColumnRms(log->tau);
    AddDriveNoise(.02, 1e-4, &random, log);
    for (int at = 100; at + 10 < log->size(); at += 1000) {
      log->tau.middleRows(at, 10).rowwise() += 50 * sigma.transpose();
    }
  }
  double worst[2];
  for (const RobustLoss loss : {RobustLoss::kHuber, RobustLoss::kSquared}) {
    LinearCalibrationOptions options = DriveOptions();
    options.loss = loss;
    const DriveGains result =
        EstimateFromLogs(driven.arm.file, driven.payload.mass, {currents.bare},
                         {currents.loaded}, options);
    ASSERT_TRUE(result.solved) << result.reason;
    double& w = worst[loss == RobustLoss::kSquared];
    w = 0;
    for (int j = 0; j < 6; ++j) {
      const double error = result.gains[j].value - driven.K[j];
      w = std::max(w, std::abs(error) / driven.K[j]);
      if (loss == RobustLoss::kHuber) {
        EXPECT_LT(std::abs(error), 4 * result.gains[j].stddev) << j;
        EXPECT_GT(result.outliers[j], 0) << j;
      }
    }
  }
  EXPECT_LT(worst[0], worst[1] / 2);
}

}  // namespace armcal::drive_gains_test
