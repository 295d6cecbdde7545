#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "model/text/input_error.h"
#include "tests/blind/blind_runner.h"
#include "tests/blind/isolated_process.h"

namespace armcal::runner_test {

namespace fs = std::filesystem;

// A bench with two cases and their labels, and a diagnoser that is a script.
class BlindRunner : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(testing::TempDir()) /
            (std::string("blind_runner_") + test->name());
    fs::remove_all(root_);
    for (const char* name : {"case_0000", "case_0001"}) {
      fs::create_directories(root_ / "logs" / name);
      Write(root_ / "logs" / name / "case.json",
            R"({"trust": 0.0625, "reference": false})");
      Write(root_ / "logs" / name / "training.csv", name);
    }
    options_.diagnoser = root_ / "diagnoser";
    options_.logs = root_ / "logs";
    options_.labels = root_ / "labels";
    options_.answers = root_ / "answers";
    options_.timeout_s = 20;
  }
  void TearDown() override { fs::remove_all(root_); }

  void WriteLabels() const {
    fs::create_directories(root_ / "labels");
    for (const char* name : {"case_0000", "case_0001"}) {
      Write(root_ / "labels" / (std::string(name) + ".json"), "the secret");
    }
  }
  // What a script prints becomes the diagnosis.
  BlindRunSummary Run(const std::string& script) const {
    Write(options_.diagnoser,
          "#!/bin/sh\nmkdir out\n{\n" + script + "\n} > out/diagnosis.json\n");
    return RunBlindCases(options_);
  }
  std::string Answer(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(root_ / "answers" / name / "diagnosis.json").rdbuf();
    return text.str();
  }
  static void Write(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
  }

  fs::path root_;
  BlindRunOptions options_;
};

TEST_F(BlindRunner, OtherValidationTakesThePlaceOfTheCases) {
  Write(root_ / "logs" / "case_0001" / "validation.csv", "noisy");
  fs::create_directories(root_ / "quiet" / "case_0001");
  Write(root_ / "quiet" / "case_0001" / "validation.csv", "quiet");
  options_.validation = root_ / "quiet";
  options_.flags = {"--forward=false"};
  EXPECT_EQ(Run("cat validation.csv; echo \" $*\"").answered, 1);
  EXPECT_EQ(Answer("case_0001"),
            "quiet diagnose --robot=robot.yaml --trust=0.0625 "
            "--log=training.csv --validate=validation.csv --forward=false "
            "--out=out\n");
}

TEST_F(BlindRunner, GivesTheCaseAndKeepsTheAnswer) {
  const BlindRunSummary summary =
      Run("cat training.csv; echo \" $*\"; pwd; ls");
  EXPECT_EQ(summary.answered, 2);
  const std::string answer = Answer("case_0001");
  EXPECT_EQ(answer.find("case_0001 diagnose --robot=robot.yaml --trust=0.0625 "
                        "--log=training.csv --validate=validation.csv "
                        "--out=out\n"),
            0u)
      << answer;
  // Neither its folder nor what lies there tells the number of the case.
  EXPECT_EQ(answer.find("case_0001", 9), std::string::npos) << answer;
  EXPECT_TRUE(fs::exists(root_ / "answers/case_0000/run.json"));
}

// A case of another kind: no trust, nothing held out, flags of its own.
TEST_F(BlindRunner, TakesFlagsFromTheCase) {
  Write(root_ / "logs/case_0001/case.json",
        R"({"robot": "robot.urdf", "reference": true, "validation": false,
            "flags": ["--torque_constants=1,2"]})");
  Write(root_ / "logs/case_0001/robot.urdf", "the arm");
  EXPECT_EQ(Run("echo \"$*\"; cat robot.urdf").answered, 2);
  EXPECT_EQ(Answer("case_0001"),
            "diagnose --robot=robot.urdf --log=training.csv "
            "--reference=reference.csv --torque_constants=1,2 --out=out\n"
            "the arm");
}

TEST_F(BlindRunner, GoesOnWhereItStopped) {
  EXPECT_EQ(Run("echo first").answered, 2);
  fs::remove_all(root_ / "answers/case_0001");
  const BlindRunSummary summary = Run("echo second");
  EXPECT_EQ(summary.kept, 1);
  EXPECT_EQ(summary.answered, 1);
  EXPECT_EQ(Answer("case_0000"), "first\n");
  EXPECT_EQ(Answer("case_0001"), "second\n");
}

// From within the diagnoser's process, by any path.
TEST_F(BlindRunner, LabelsCannotBeRead) {
  WriteLabels();
  const std::string labels = root_ / "labels";
  const std::string spy = "cat " + labels + "/*.json " + labels +
                          "/case_0000.json; ls " + labels + "; chmod 777 " +
                          labels;
  if (!CanIsolate()) {
    EXPECT_THROW(Run(spy), InputError);
    return;
  }
  EXPECT_EQ(Run(spy).answered, 2);
  EXPECT_EQ(Answer("case_0000"), "");
  EXPECT_EQ(Answer("case_0001"), "");
}

TEST_F(BlindRunner, KillsWhatTakesTooLong) {
  options_.timeout_s = .3;
  const BlindRunSummary summary = Run("sleep 60");
  EXPECT_EQ(summary.failed, 2);
  EXPECT_FALSE(fs::exists(root_ / "answers/case_0000/diagnosis.json"));
  std::ifstream file(root_ / "answers/case_0000/run.json");
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("\"timed_out\": true"), std::string::npos);
}

}  // namespace armcal::runner_test
