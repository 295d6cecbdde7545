#include "calib/inspect/log_coverage.h"

#include <gmock/gmock.h>

#include "calib/inspect/inspection.h"
#include "tests/fixtures/inspected_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::log_coverage_test {

using testing::HasSubstr;
using testing::Not;

// Of a log of so many seconds at 100 Hz.
std::string TooShort(double duration) {
  const InspectedArm arm("3R elbow", duration);
  LogReaderOptions options;
  options.joint_names = arm.robot.JointNames();
  return CoverageOf(arm.robot, WriteFile(LogCsv(arm.log), "short.csv"), options)
      .too_short;
}

// By hand: three parts of 4 periods and 12 samples at 2.5 times the bandwidth,
// and 4 periods at both ends, are 34.4 periods; the bandwidth is 10 Hz.
TEST(LogCoverage, SaysThatALogIsTooShortForADiagnosis) {
  EXPECT_EQ(TooShort(20), "");
  EXPECT_THAT(TooShort(2.5), HasSubstr("to hold some of it out: "));
  EXPECT_THAT(TooShort(1.5), Not(HasSubstr("to hold some of it out")));
  EXPECT_THAT(TooShort(1.5),
              HasSubstr("3.44 s in motion without a gap are needed at 10 Hz"));
}

// Three rows of 29 are lost in a log that is long enough.
TEST(LogCoverage, SaysThatGapsLeaveNothingForADiagnosis) {
  const InspectedArm arm("3R elbow");
  std::vector<int> rows;
  for (int k = 0; k < arm.log.size(); ++k) {
    if (k % 29 > 2) rows.push_back(k);
  }
  Log log;
  log.t = arm.log.t(rows);
  log.q = arm.log.q(rows, Eigen::all);
  log.tau = arm.log.tau(rows, Eigen::all);
  LogReaderOptions options;
  options.joint_names = arm.robot.JointNames();
  const std::string path = WriteFile(LogCsv(log), "gaps.csv");
  EXPECT_THAT(CoverageOf(arm.robot, path, options).too_short,
              HasSubstr("gaps of up to 0.04 s split this log there"));
  const LogInspection inspection = InspectLog(arm.robot, path, options);
  std::string sentences;
  for (const InspectionFinding& finding : inspection.findings) {
    sentences += finding.sentence + "\n";
  }
  EXPECT_THAT(sentences, HasSubstr("the holes leave too little motion"));
  EXPECT_THAT(sentences, Not(HasSubstr("hardly moves")));
}

}  // namespace armcal::log_coverage_test
