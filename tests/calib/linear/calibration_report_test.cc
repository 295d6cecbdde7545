#include "calib/linear/calibration_report.h"

#include <gmock/gmock.h>

#include <sstream>
#include <vector>

#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::calibration_report_test {

using testing::HasSubstr;

std::vector<std::string> LinesWith(const std::string& part,
                                   const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.find(part) != std::string::npos) lines.push_back(line);
  }
  return lines;
}

// One of six joints moves: most directions stay open.
LinearCalibration OfPoorLog(Robot* robot) {
  std::mt19937_64 random(3);
  SetRandomInertials(&random, robot);
  Log log = RecordMotion(RandomMultisine(&random, 6), 5, .01);
  log.q.leftCols(5).rowwise() = log.q.row(0).head(5).eval();
  log.qd.leftCols(5).setZero();
  log.qdd.leftCols(5).setZero();
  AddTorque(*robot, &log);
  AddNoise(&random, .01 * ColumnRms(log.tau), &log.tau);
  return CalibrateLogs(*robot, {log}, {});
}

class PoorLog : public testing::Test {
 protected:
  Robot robot_ = SampleRobot("PUMA560 6R");
  const LinearCalibration result_ = OfPoorLog(&robot_);
  const std::string text_ = EstimateText(robot_, result_);
};

TEST_F(PoorLog, NamesTheFirstDirectionsAndCountsTheOthers) {
  const size_t all = result_.identifiability.directions.size();
  ASSERT_GT(all, 3u);
  EXPECT_EQ(LinesWith("not identifiable: ", text_).size(), 3u);
  EXPECT_THAT(text_, HasSubstr("... and " + std::to_string(all - 3) +
                               " more (in calibration.json)\n"));
  EXPECT_EQ(ToJson(robot_, result_)["rank"]["unidentifiable"].size(), all);
}

// The solver's number would be read as an estimate.
TEST_F(PoorLog, HasNoNumbersForWhatIsNotSeen) {
  const std::vector<std::string> lines = LinesWith("(not seen)", text_);
  ASSERT_FALSE(lines.empty());
  for (const std::string& line : lines) {
    EXPECT_THAT(line, HasSubstr("          - (not seen)"));
  }
}

}  // namespace armcal::calibration_report_test
