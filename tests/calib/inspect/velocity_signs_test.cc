#include "calib/inspect/velocity_signs.h"

#include <gtest/gtest.h>

#include "calib/inspect/inspection.h"
#include "model/log_files/log_writer.h"
#include "tests/fixtures/inspected_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::velocity_signs_test {

// Shoulder and elbow of an arm, which move in one upright plane, with the
// velocities that were recorded: an arm that is its own mirror image, so that
// torques tell no difference between all positions and all torques turned.
class VelocitySignsTest : public testing::Test {
 protected:
  VelocitySignsTest() : arm_("3R elbow") {
    options_.joint_names = arm_.robot.JointNames();
  }
  LogInspection Inspect(const Log& log) {
    return InspectLog(arm_.robot, WriteFile(LogCsv(log), "turned.csv"),
                      options_);
  }

  InspectedArm arm_;
  LogReaderOptions options_;
};

TEST_F(VelocitySignsTest, AllTorquesAreToldAtOnceAndMended) {
  Log wrong = arm_.log;
  wrong.tau *= -1;
  const LogInspection inspection = Inspect(wrong);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "torque_sign");
  EXPECT_EQ(inspection.findings[0].joint, -1);
  EXPECT_EQ(
      inspection.findings[0].sentence.find("all torques have the wrong sign"),
      0u);
  EXPECT_FALSE(inspection.as_it_is);
  const Log mended = Mended(arm_.robot, wrong, inspection);
  EXPECT_TRUE(mended.tau.isApprox(arm_.log.tau));
  EXPECT_TRUE(mended.q.isApprox(arm_.log.q));
  EXPECT_TRUE(Inspect(mended).findings.empty());
}

// Found as all torques, and the last turned back: that it has the wrong sign
// would be false.
TEST_F(VelocitySignsTest, AllTorquesButOneAreOneFinding) {
  const Log right = InspectedArm("PUMA560 6R").log;
  arm_ = InspectedArm("PUMA560 6R");
  options_.joint_names = arm_.robot.JointNames();
  arm_.log.tau.leftCols(5) *= -1;
  const LogInspection inspection = Inspect(arm_.log);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].sentence,
            "all torques but that of joint6 have the wrong sign");
  EXPECT_TRUE(Mended(arm_.robot, arm_.log, inspection).tau.isApprox(right.tau));
}

TEST_F(VelocitySignsTest, ThoseThatAreOppositeSayThatItIsThePositions) {
  Log wrong = arm_.log;
  wrong.q *= -1;
  const LogInspection inspection = Inspect(wrong);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "position_sign");
  EXPECT_EQ(inspection.findings[0].joint, -1);
  const Log mended = Mended(arm_.robot, wrong, inspection);
  EXPECT_TRUE(mended.tau.isApprox(arm_.log.tau));
  EXPECT_TRUE(mended.q.isApprox(arm_.log.q));
  EXPECT_TRUE(mended.qd.isApprox(arm_.log.qd));
}

// Of two readings that fit alike, the one that velocities name; without them
// the torques, of which one convention makes the sign of all.
TEST_F(VelocitySignsTest, OfTwoThatFitAlikeTheyChoose) {
  using Kind = ReadingChange::Kind;
  const auto chosen = [&](Kind first, Kind other, bool opposite) {
    ReadingFinding found{LogReading(arm_.robot), {{first}}, 0, 0};
    found.changes[0].alternatives = {{other}};
    Wiring& wiring = found.reading.wiring;
    (first == Kind::kAllTorqueSigns ? wiring.torque_sign
                                    : wiring.position_sign) *= -1;
    BelieveVelocities({opposite, opposite, false}, &found);
    const bool torques = found.changes[0].kind == Kind::kAllTorqueSigns;
    EXPECT_NE(found.changes[0].alternatives[0].kind, found.changes[0].kind);
    EXPECT_EQ(wiring.torque_sign,
              Eigen::VectorXd::Constant(3, torques ? -1 : 1));
    EXPECT_EQ(wiring.position_sign,
              Eigen::VectorXd::Constant(3, torques ? 1 : -1));
    return found.changes[0].kind;
  };
  const Kind torques = Kind::kAllTorqueSigns,
             positions = Kind::kAllPositionSigns;
  EXPECT_EQ(chosen(torques, positions, false), torques);
  EXPECT_EQ(chosen(positions, torques, false), torques);
  EXPECT_EQ(chosen(torques, positions, true), positions);
  EXPECT_EQ(chosen(positions, torques, true), positions);
}

}  // namespace armcal::velocity_signs_test
