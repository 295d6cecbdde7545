#include "calib/poses/diagnosis/compliance_reader.h"

#include <gtest/gtest.h>

#include "model/text/input_error.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::compliance_reader_test {

std::string Diagnosis(const std::string& robot, const std::string& effects) {
  return WriteFile(
      "{\"robot\": \"" + robot + "\", \"effects\": [" + effects + "]}",
      "diagnosis.json");
}

std::string Elasticity(const std::string& stiffness) {
  return "{\"effect\": \"delay\"}, {\"effect\": \"elasticity\", "
         "\"joint_index\": 2, \"estimates\": [{\"name\": \"stiffness\", "
         "\"value\": " +
         stiffness + ", \"stddev\": 400}]}";
}

TEST(ComplianceReader, IsOneOverTheStiffness) {
  const Robot robot = SampleRobot("UR5 6R");
  const auto told =
      ReadCompliance(Diagnosis(robot.name, Elasticity("2e4")), robot);
  ASSERT_EQ(told.size(), 6u);
  EXPECT_NEAR(told[1].value, 5e-5, 1e-12);
  EXPECT_NEAR(told[1].stddev, 1e-6, 1e-12);
  EXPECT_EQ(told[0].stddev, 0);
}

TEST(ComplianceReader, RefusesWhatTellsNone) {
  const Robot robot = SampleRobot("UR5 6R");
  const auto message = [&](const std::string& path) {
    return MessageOf<InputError>(path, [&] { ReadCompliance(path, robot); });
  };
  EXPECT_NE(message(Diagnosis("other", "")).find("of another one"),
            std::string::npos);
  EXPECT_NE(message(Diagnosis(robot.name, ""))
                .find("expected a joint that gives way"),
            std::string::npos);
  EXPECT_NE(message(Diagnosis(robot.name, Elasticity("-1")))
                .find("expected a stiffness above 0"),
            std::string::npos);
}

}  // namespace armcal::compliance_reader_test
