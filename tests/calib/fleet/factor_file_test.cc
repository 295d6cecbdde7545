#include "calib/fleet/factor_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "calib/fleet/combine.h"
#include "calib/fleet/factor_calibration.h"
#include "calib/fleet/log_reduction.h"
#include "calib/linear/calibrate_linear.h"
#include "calib/linear/log_factors.h"
#include "calib/numerics/sha256.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::factor_file_test {

using Eigen::MatrixXd;
using testing::HasSubstr;

// Three noisy logs of a 2R arm.
class FactorFile : public testing::Test {
 protected:
  FactorFile() : robot_(SampleRobot("2R planar (vertical plane)")) {
    std::mt19937_64 random(31);
    SetRandomInertials(&random, &robot_);
    for (int k = 0; k < 3; ++k) {
      Log log = RecordMotion(RandomMultisine(&random, 2), 6 + k, .01);
      AddTorque(robot_, &log);
      AddNoise(&random, Eigen::Vector2d(.3, .1), &log.tau);
      paths_.push_back(
          WriteFile(LogCsv(log, true), "log" + std::to_string(k) + ".csv"));
    }
    reader_.joint_names = robot_.JointNames();
    options_.joint_terms = {JointTerm::kViscous, JointTerm::kOffset};
    options_.bandwidth_hz = 10;
    options_.loss = RobustLoss::kSquared;
  }
  LogSet Open(const std::vector<std::string>& paths) const {
    return LogSet(LogFiles(paths), reader_, TimeRange());
  }
  // Each log by itself, as separate runs would.
  std::vector<Reduction> Reduced() const {
    std::vector<Reduction> parts;
    for (const std::string& path : paths_) {
      LogSet log = Open({path});
      const ReductionModel model =
          ChooseReductionModel(robot_, "the robot's", options_, log);
      ReducedLog reduced = ReduceLog(robot_, model, {}, log);
      reduced.sha256 = HexText(Sha256Of(path));
      parts.push_back({model, {reduced}});
    }
    return parts;
  }
  static Reduction Together(const std::vector<Reduction>& parts) {
    std::vector<std::pair<std::string, Reduction>> named;
    for (const Reduction& part : parts) {
      named.emplace_back("file" + std::to_string(named.size()), part);
    }
    return Combine(named);
  }
  std::string Refusal(const std::string& bytes) const {
    return MessageOf<InputError>("f.factor",
                                 [&] { ParseFactorFile("f.factor", bytes); });
  }

  Robot robot_;
  std::vector<std::string> paths_;
  LogReaderOptions reader_;
  LinearCalibrationOptions options_;
};

// One pass over all logs, which knows nothing of files and merging.
TEST_F(FactorFile, MergedIsTheSinglePass) {
  const Reduction all = Together(Reduced());
  LogSet logs = Open(paths_);
  const LinearCalibration expected =
      CalibrateLinear(robot_, options_, logs, nullptr);
  const LinearCalibration merged = CalibrateFromFactors(robot_, all);
  ASSERT_TRUE(expected.solved && merged.solved);
  EXPECT_EQ(merged.equations, expected.equations);
  EXPECT_LE((merged.x - expected.x).norm(), 1e-12 * expected.x.norm());
  EXPECT_LE((merged.noise - expected.noise).norm(),
            1e-12 * expected.noise.norm());
  EXPECT_EQ(merged.travel, expected.travel);
  EXPECT_EQ(merged.identifiable, expected.identifiable);
  const LogFactors pass(expected.parameters, expected.rows, {},
                        Prepare(logs, expected.preparation));
  for (int i = 0; i < 2; ++i) {
    MatrixXd one, other;
    BlockTriangularFactor both(expected.parameters), single = both;
    for (int k = 0; k < 3; ++k) {
      both.Merge(FactorOf(expected.parameters, all.logs[k]), i);
      single.Merge(pass.log(k), i);
    }
    one = both.Triangle(i).cwiseAbs(), other = single.Triangle(i).cwiseAbs();
    EXPECT_LE((one - other).norm(), 1e-12 * other.norm());
  }
  // Noise is white, rows overlap: the single pass measures what each log's
  // inflation carries along.
  for (Eigen::Index k = 0; k < merged.x.size(); ++k) {
    EXPECT_NEAR(merged.stddev[k] / expected.stddev[k], 1, .5);
  }
}

TEST_F(FactorFile, SameBitsInAnyOrderAndGrouping) {
  const std::vector<Reduction> parts = Reduced();
  const Reduction all = Together(parts);
  const std::string bytes = FactorFileBytes(all);
  const auto x = CalibrateFromFactors(robot_, all).x;
  const Reduction stored = ParseFactorFile("f", bytes);
  EXPECT_EQ(FactorFileBytes(stored), bytes);
  std::vector<int> order = {0, 1, 2};
  do {
    const Reduction pair = Together({parts[order[0]], parts[order[1]]});
    const Reduction other = Together(
        {parts[order[2]], ParseFactorFile("f", FactorFileBytes(pair))});
    EXPECT_EQ(FactorFileBytes(other), bytes);
    EXPECT_EQ(CalibrateFromFactors(robot_, other).x, x);
  } while (std::next_permutation(order.begin(), order.end()));
}

// Read by hand: the numbers lie before the 32 bytes of the digest.
TEST_F(FactorFile, HoldsExactDoubles) {
  const Reduction log = Reduced()[0];
  const std::string bytes = FactorFileBytes(log);
  EXPECT_EQ(bytes.substr(0, 16), "armcal factor 1\n");
  const MatrixXd R = log.logs[0].factors[1].Triangle();
  std::vector<double> last(R.cols());
  std::memcpy(last.data(), bytes.data() + bytes.size() - 32 - 8 * R.cols(),
              8 * last.size());
  for (Eigen::Index r = 0; r < R.rows(); ++r) {
    EXPECT_EQ(last[r], R(r, R.cols() - 1));
  }
}

TEST_F(FactorFile, RobustWeightsAreTheLogsOwn) {
  options_.loss = std::nullopt;  // Huber's
  for (const Reduction& part : Reduced()) {
    EXPECT_EQ(part.model.loss, RobustLoss::kHuber);
    const LinearCalibration merged = CalibrateFromFactors(robot_, part);
    // Of Gaussian noise hardly anything is weighed down.
    const Eigen::VectorXd X = merged.parameters.Values(robot_);
    for (Eigen::Index k = 0; k < X.size(); ++k) {
      EXPECT_NEAR(merged.x[k], X[k], 5 * merged.stddev[k]);
    }
  }
}

TEST_F(FactorFile, RefusesWhatIsNotWhole) {
  const std::string bytes = FactorFileBytes(Reduced()[0]);
  EXPECT_EQ(Refusal(bytes), "");
  EXPECT_THAT(Refusal("t,q1\n0,1\n"), HasSubstr("expected a factor file"));
  std::string newer = bytes;
  newer[14] = '2';
  EXPECT_THAT(Refusal(newer), HasSubstr("version: found '2': expected 1"));
  EXPECT_THAT(Refusal(bytes.substr(0, 20)), HasSubstr("ends too early"));
  for (const size_t size : {bytes.size() - 1, bytes.size() / 2}) {
    EXPECT_THAT(Refusal(bytes.substr(0, size)), HasSubstr("checksum"));
  }
  for (const size_t at : {size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    EXPECT_THAT(Refusal(damaged), HasSubstr("the file is damaged"));
  }
  // A right checksum of a wrong content.
  std::string forged = bytes.substr(0, bytes.size() - 40);
  const Sha256::Digest digest = Sha256Of(forged);
  forged.append(digest.begin(), digest.end());
  EXPECT_THAT(Refusal(forged), HasSubstr("ends too early"));
}

TEST_F(FactorFile, RefusesWhatDoesNotBelongTogether) {
  const std::vector<Reduction> parts = Reduced();
  const auto refusal = [&](const Reduction& other) {
    return MessageOf<InputError>("file1", [&] { Together({parts[0], other}); });
  };
  EXPECT_THAT(refusal(parts[0]), HasSubstr("count twice"));
  Reduction changed = parts[1];
  changed.model.rows.window_s = .7;
  EXPECT_THAT(refusal(changed),
              HasSubstr("FILE: key model.window_s: found '0.7': expected 0.16 "
                        "as in file0; reduce the log with `like`=file0"));
  Reduction foreign = parts[1];
  foreign.model.robot_sha256 = "another";
  EXPECT_THAT(refusal(foreign), HasSubstr("the robot file of file0"));
  // Halves of a log are different evidence, overlapping ones are not.
  Reduction half = parts[0];
  half.logs[0].range = {half.logs[0].range.end, 1e3};
  EXPECT_EQ(refusal(half), "");
  half.logs[0].range.begin -= 1;
  EXPECT_THAT(refusal(half), HasSubstr("count twice"));
  EXPECT_THAT(
      MessageOf<InputError>(
          "f",
          [&] { ParametersOf(SampleRobot("UR5 6R"), parts[0].model, "f"); }),
      HasSubstr("FILE: key model.parameters: expected those of UR5"));
}

}  // namespace armcal::factor_file_test
