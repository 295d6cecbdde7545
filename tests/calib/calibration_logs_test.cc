#include "calib/calibration_logs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calib/numerics/sha256.h"

namespace armcal::calibration_logs_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A folder in which logs/a.csv and logs/b.csv were calibrated to fitted/.
class CalibrationLogsTest : public testing::Test {
 protected:
  CalibrationLogsTest() : folder_(testing::TempDir() + "calibration_logs") {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "fitted");
    fs::create_directories(folder_ / "logs");
    nlohmann::json files = nlohmann::json::array();
    for (const std::string log : {"logs/a.csv", "logs/b.csv"}) {
      Write(log, "t,q1,tau1\n0,1,2\n" + log);
      const FileHash hash = HashOfFile((folder_ / log).string());
      files.push_back(
          {{"path", log}, {"sha256", hash.sha256}, {"bytes", hash.bytes}});
      calibrated_.logs.push_back(log);
    }
    calibrated_.log_ranges = {{2, 20}, {2, 12.5}};
    Write("fitted/provenance.json", nlohmann::json({{"files", files}}).dump());
  }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  CalibrationLogs Find(const std::vector<LogSource>& used = {}) const {
    return FindCalibrationLogs((folder_ / "fitted/calibration.json").string(),
                               calibrated_, used);
  }

  fs::path folder_;
  CalibratedRobot calibrated_;
};

TEST_F(CalibrationLogsTest, AreFoundFromTheFolderAboveTheirs) {
  const CalibrationLogs found = Find();
  EXPECT_EQ(found.missing, "");
  ASSERT_EQ(found.input.logs.size(), 2u);
  EXPECT_EQ(found.input.logs[1].name, "logs/b.csv");
  EXPECT_TRUE(
      fs::equivalent(found.input.logs[1].path(), folder_ / "logs/b.csv"));
  // One crop, in which the second log ended.
  EXPECT_EQ(found.input.crop.begin, 2);
  EXPECT_EQ(found.input.crop.end, 20);
}

TEST_F(CalibrationLogsTest, OneThatIsDiagnosedIsLeftOut) {
  const CalibrationLogs found = Find({(folder_ / "logs/a.csv").string()});
  ASSERT_EQ(found.input.logs.size(), 1u);
  EXPECT_EQ(found.input.logs[0].name, "logs/b.csv");
}

// A file of the same name and size may be another day's.
TEST_F(CalibrationLogsTest, AnotherLogOfThatNameIsNone) {
  Write("logs/b.csv", "t,q1,tau1\n0,1,3\nlogs/b.csv");
  const CalibrationLogs found = Find();
  EXPECT_TRUE(found.input.logs.empty());
  EXPECT_THAT(found.missing, HasSubstr("logs/b.csv is not there as it was"));
}

TEST_F(CalibrationLogsTest, NothingTellsThemWithoutProvenance) {
  fs::remove(folder_ / "fitted/provenance.json");
  EXPECT_TRUE(Find().input.logs.empty());
  EXPECT_THAT(Find().missing, HasSubstr("logs/a.csv"));
}

}  // namespace armcal::calibration_logs_test
