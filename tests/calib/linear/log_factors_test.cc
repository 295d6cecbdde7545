#include "calib/linear/log_factors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/linear/calibration_model.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::log_factors_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Three logs of a 2R arm; the second swings joint 2 freely, the third records
// no torque of joint 2 at all.
class Factors : public testing::Test {
 protected:
  Factors() : robot_(SampleRobot("2R planar (vertical plane)")) {
    std::mt19937_64 random(31);
    SetRandomInertials(&random, &robot_);
    std::vector<std::string> paths;
    for (int k = 0; k < 3; ++k) {
      logs_.push_back(RecordMotion(RandomMultisine(&random, 2), 3 + k, .01));
      AddTorque(robot_, &logs_[k]);
      if (k == 1) logs_[k].tau.col(1) *= .01;
      if (k == 2) logs_[k].tau.col(1).setZero();
      paths.push_back(WriteFile(LogCsv(logs_[k], true),
                                "log" + std::to_string(k) + ".csv"));
    }
    LogReaderOptions reader;
    reader.joint_names = robot_.JointNames();
    RowOptions rows;
    rows.identification = Identification::kDifferential;
    set_ = Prepare(LogSet(LogFiles(paths), reader, TimeRange()),
                   PreparationForRows(rows));
    parameters_.emplace(robot_, ModelParameters::Options());
    factors_.emplace(*parameters_, rows, Progress(), *set_);
  }
  // [U | tau]' [U | tau] of joint i in log k, in its own columns.
  MatrixXd Gram(int k, int i) const {
    const std::vector<int>& columns = parameters_->row_columns(i);
    MatrixXd A(logs_[k].size(), columns.size() + 1), U;
    Regressor regressor = parameters_->MakeRegressor();
    for (int s = 0; s < logs_[k].size(); ++s) {
      regressor.Differential(logs_[k].q.row(s), logs_[k].qd.row(s),
                             logs_[k].qdd.row(s), VectorXd(), &U);
      for (size_t c = 0; c < columns.size(); ++c) A(s, c) = U(i, columns[c]);
      A(s, columns.size()) = logs_[k].tau(s, i);
    }
    return A.transpose() * A;
  }
  static void ExpectGram(const BlockTriangularFactor& factor, int i,
                         const MatrixXd& gram) {
    const MatrixXd R = factor.Triangle(i);
    EXPECT_LE((R.transpose() * R - gram).norm(), 1e-10 * gram.norm());
  }

  Robot robot_;
  std::vector<Log> logs_;
  std::optional<PreparedLogs> set_;
  std::optional<ModelParameters> parameters_;
  std::optional<LogFactors> factors_;
};

TEST_F(Factors, EachLogHasItsOwn) {
  ASSERT_EQ(factors_->size(), 3);
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 2; ++i) {
      ExpectGram(factors_->log(k), i, Gram(k, i));
      EXPECT_EQ(factors_->log(k).rows(i), logs_[k].size());
    }
  }
}

TEST_F(Factors, MergesWhatIsPowered) {
  const auto merged = factors_->Merged(
      *parameters_, {{true, false}, {true, true}, {false, true}});
  ExpectGram(merged, 0, Gram(0, 0) + Gram(1, 0));
  ExpectGram(merged, 1, Gram(1, 1) + Gram(2, 1));
  EXPECT_EQ(merged.rows(0), logs_[0].size() + logs_[1].size());
  EXPECT_EQ(merged.rows(1), logs_[1].size() + logs_[2].size());
}

TEST_F(Factors, MeanSquareSpeed) {
  for (int j = 0; j < 2; ++j) {
    double squares = 0, count = 0;
    for (const Log& log : logs_) {
      squares += log.qd.col(j).squaredNorm();
      count += log.size();
    }
    EXPECT_NEAR(factors_->mean_square_speed()[j], squares / count, 1e-12);
  }
}

TEST_F(Factors, FreeSwingIsNotPowered) {
  const VectorXd X = parameters_->Values(robot_);
  EXPECT_EQ(FindPowered(*factors_, X, .1),
            (std::vector<std::vector<bool>>{
                {true, true}, {true, false}, {true, false}}));
  EXPECT_EQ(FindPowered(*factors_, X, 1e-4)[1],
            (std::vector<bool>{true, true}));
  // An arm without mass leaves nothing to compare with.
  EXPECT_EQ(FindPowered(*factors_, VectorXd::Zero(X.size()), .1),
            (std::vector<std::vector<bool>>{
                {true, true}, {true, true}, {true, false}}));
}

TEST_F(Factors, Nonzero) {
  EXPECT_EQ(FindNonzero(*factors_),
            (std::vector<std::vector<bool>>{
                {true, true}, {true, true}, {true, false}}));
}

TEST_F(Factors, ReportsProgress) {
  double last = -1;
  const LogFactors again(
      *parameters_, RowOptions(),
      [&](const std::string& stage, double fraction) {
        EXPECT_FALSE(stage.empty());
        EXPECT_GE(fraction, last);
        last = fraction;
      },
      *set_);
  EXPECT_EQ(last, 1);
}

}  // namespace armcal::log_factors_test
