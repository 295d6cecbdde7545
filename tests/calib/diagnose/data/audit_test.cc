#include "calib/diagnose/data/audit.h"

#include "calib/diagnose/data/segments.h"
#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::audit_test {

class GapAuditTest : public DiagnosedArm<32> {
 protected:
  std::vector<DataFinding> Audit(const Log& log) {
    LogReaderOptions reader;
    reader.joint_names = File().JointNames();
    LogSet logs({WriteFile(LogCsv(log), "audited.csv")}, reader, {});
    const std::vector<GapSegment> segments = ReadSegments(6, {}, logs);
    GapRows rows(segments, 6);
    return AuditTorque(File(), rows);
  }
};

TEST_F(GapAuditTest, WrongSamplesOfPositionsAreTold) {
  const auto tell = [&](const Log& log) {
    LogReaderOptions reader;
    reader.joint_names = File().JointNames();
    LogSet logs({WriteFile(LogCsv(log), "spoilt.csv")}, reader, {});
    return TellPositionSpikes(File(), ReadSegments(6, {}, logs));
  };
  Log log = plant_->Run(truth_);
  EXPECT_TRUE(tell(log).empty());
  log.q(log.size() / 2, 0) += 1;
  const auto findings = tell(log);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_NE(findings[0].finding.find(File().links[0].joint.name),
            std::string::npos);
  EXPECT_EQ(findings[0].evidence.substr(0, 2), "1,");
}

TEST_F(GapAuditTest, MeasuredTorqueIsNoLawOfPosition) {
  EXPECT_TRUE(Audit(plant_->Run(truth_)).empty());
}

// Measured by an arm a hundred times lighter than the file: what the file's
// links would need is no measure of what a law of position leaves.
TEST_F(GapAuditTest, AMeasuredTorqueThatIsSmallIsNoLawOfPosition) {
  Log log = plant_->Run(truth_);
  log.tau /= 100;
  EXPECT_TRUE(Audit(log).empty());
}

// As a gravity compensation logs its own command.
TEST_F(GapAuditTest, TorqueComputedFromPositionIsFound) {
  Log log = plant_->Run(truth_);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(2);
  for (int k = 0; k < log.size(); ++k) {
    log.tau.row(k) = InverseDynamics(File(), log.q.row(k), rest, rest);
  }
  const std::vector<DataFinding> findings = Audit(log);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_THAT(findings[0].finding, testing::HasSubstr("positions"));
}

}  // namespace armcal::audit_test
