#include "calib/compare/compared_result.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "model/text/input_error.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::compared_result_test {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using Kind = ComparedResult::Kind;

Robot NoRobot(const std::string& path) {
  throw InputError(path, "", "", "no robot");
}

std::string Refusal(const std::string& path) {
  return MessageOf<InputError>("", [&] { ReadResult(path, NoRobot); });
}

json CalibrationJson() {
  return {
      {"format", "armcal calibration 1"},
      {"robot", "arm"},
      {"stacked_residual_percent", 1.25},
      {"logs",
       json::array({{{"file", "monday.csv"}, {"begin_s", 1}, {"end_s", 9}}})},
      {"model_parameters",
       {{{"name", "Izz[1]"}, {"unit", "kg m^2"}, {"value", 2}, {"stddev", .5}},
        {{"name", "m[2]"}, {"unit", "kg"}, {"value", 3}, {"stddev", nullptr}}}},
      {"covariance", {{"file", "covariance.csv"}}}};
}

TEST(ComparedResult, OfACalibration) {
  const std::string path =
      WriteFile(CalibrationJson().dump(), "calibration.json");
  const auto csv =
      std::filesystem::path(path).replace_filename("covariance.csv");
  std::filesystem::rename(
      WriteFile("\"Izz[1]\",\"m[2]\"\n.25,\n,\n", "covariance.csv"), csv);
  const ComparedResult result = ReadResult(path, NoRobot);
  EXPECT_EQ(result.kind, Kind::kCalibration);
  EXPECT_EQ(result.robot, "arm");
  EXPECT_EQ(result.verdict, "calibrated, residual 1.25 %");
  ASSERT_EQ(result.logs.size(), 1u);
  EXPECT_TRUE(result.logs[0].Overlaps({"monday.csv", 8, 20}));
  EXPECT_FALSE(result.logs[0].Overlaps({"monday.csv", 9, 20}));
  EXPECT_FALSE(result.logs[0].Overlaps({"tuesday.csv", 8, 20}));
  ASSERT_EQ(result.sets.size(), 1u);
  EXPECT_EQ(result.sets[0].values[0].stddev, .5);
  EXPECT_TRUE(std::isnan(result.sets[0].values[1].stddev));
  EXPECT_EQ(result.sets[0].covariance(0, 0), .25);
}

TEST(ComparedResult, OfADiagnosis) {
  const json diagnosis = {
      {"format", "armcal diagnosis 1"},
      {"robot", "arm"},
      {"verdict", "explained"},
      {"where", {{"joints", {{{"name", "waist"}}, {{"name", "elbow"}}}}}},
      {"untestable", {{{"effect", "armature"}, {"joint", "waist"}}}},
      {"effects",
       {{{"effect", "spring"},
         {"joint_index", 2},
         {"probability", .9},
         {"equivalent", {{{"effect", "payload"}, {"joint_index", 0}}}},
         {"estimates",
          {{{"name", "stiffness"},
            {"unit", "N m/rad"},
            {"value", 7},
            {"stddev", nullptr}}}}}}}};
  const ComparedResult result =
      ReadResult(WriteFile(diagnosis.dump(), "diagnosis.json"), NoRobot);
  EXPECT_EQ(result.kind, Kind::kDiagnosis);
  ASSERT_EQ(result.claims.size(), 1u);
  EXPECT_EQ(result.claims[0].name, "spring of elbow");
  EXPECT_TRUE(result.claims[0].claimed);
  EXPECT_THAT(result.claims[0].rivals, ElementsAre("payload"));
  EXPECT_THAT(result.untestable, ElementsAre("armature of waist"));
  EXPECT_EQ(result.sets[0].values[0].name, "spring of elbow: stiffness");
}

// Half an interval of 95 % is 1.96 standard deviations.
TEST(ComparedResult, OfAVerification) {
  const json verification = {{"format", "armcal verification 1"},
                             {"robot", "arm"},
                             {"passed", false},
                             {"rollout",
                              {{{"window_s", .5},
                                {"unit", "rad"},
                                {"before_rms", .2},
                                {"after_rms", nullptr},
                                {"ci95", {.2 - .0196, .2 + .0196}}}}}};
  const ComparedResult result =
      ReadResult(WriteFile(verification.dump(), "verification.json"), NoRobot);
  EXPECT_EQ(result.verdict, "not verified");
  EXPECT_EQ(result.sets[0].values[0].name, "error after 0.5 s");
  EXPECT_EQ(result.sets[0].values[0].value, .2);
  EXPECT_NEAR(result.sets[0].values[0].stddev, .01, 1e-12);
}

// Of another calibration, or changed by hand.
TEST(ComparedResult, AnotherCovarianceIsRefused) {
  const std::filesystem::path path =
      WriteFile(CalibrationJson().dump(), "calibration.json");
  for (const char* variance : {"4", "", "-.25"}) {
    std::filesystem::rename(
        WriteFile("\"Izz[1]\",\"m[2]\"\n" + std::string(variance) + ",\n,\n",
                  "covariance.csv"),
        std::filesystem::path(path).replace_filename("covariance.csv"));
    EXPECT_THAT(Refusal(path), HasSubstr("whose standard deviations"))
        << variance;
  }
}

TEST(ComparedResult, AFolderHasOneResult) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "compared_result";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  EXPECT_THAT(Refusal(folder), HasSubstr("expected one of calibration.json"));
  for (const char* name : {"diagnosis.json", "verification.json"}) {
    std::filesystem::copy_file(WriteFile("{}", name), folder / name);
  }
  EXPECT_THAT(Refusal(folder), HasSubstr("give the file that is meant"));
}

TEST(ComparedResult, OtherFilesAreRefused) {
  EXPECT_THAT(Refusal(WriteFile("{\"format\": \"else\", \"robot\": \"arm\"}",
                                "other.json")),
              HasSubstr("expected a result of armcal"));
  EXPECT_THAT(Refusal(WriteFile("{}", "empty.json")), HasSubstr("format"));
  EXPECT_THAT(Refusal("arm.urdf"), HasSubstr("no robot"));
  json unsolved = CalibrationJson();
  unsolved.erase("covariance");
  EXPECT_THAT(Refusal(WriteFile(unsolved.dump(), "calibration.json")),
              HasSubstr("was not solved"));
}

}  // namespace armcal::compared_result_test
