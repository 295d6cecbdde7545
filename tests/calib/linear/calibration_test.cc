#include "calib/linear/calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/calibrate_logs.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::calibration_test {

using Eigen::VectorXd;
using Law = CoulombTransition::Law;

// A UR5 with all joint terms; the offset is the last entry of a joint's terms.
class Ur5 : public testing::Test {
 protected:
  Ur5() : robot_(SampleRobot("UR5 6R")) {
    SetRandomInertials(&random_, &robot_);
    for (Link& link : robot_.links) {
      link.joint.viscous = Uniform(&random_, .5, 2);
      link.joint.coulomb = Uniform(&random_, .5, 2);
      link.joint.armature = Uniform(&random_, .1, .5);
    }
    options_.transition = CoulombTransition{Law::kVelocity, .05};
    offset_ = UniformVector(&random_, 6, -1, 1);
    log_ = Record(30);
    ModelParameters::Options model;
    model.joint_terms = options_.joint_terms;
    model.transitions.assign(6, {*options_.transition});
    const ModelParameters parameters(robot_, model);
    X_ = parameters.Values(robot_);
    for (int k = 0; k < parameters.size(); ++k) {
      const ModelParameter& p = parameters.parameters()[k];
      if (p.is_joint_term && p.term == JointTerm::kOffset) {
        X_[k] = offset_[p.block];
      }
    }
  }
  Log Record(double duration) {
    Log log = RecordMotion(RandomMultisine(&random_, 6), duration, .005);
    AddTorque(robot_, &log);
    for (int j = 0; j < 6; ++j) {
      AddCoulomb(j, robot_.links[j].joint.coulomb, *options_.transition, &log);
      log.tau.col(j).array() += offset_[j];
    }
    return log;
  }
  void AddSensorNoise(double relative) {
    AddNoise(&random_, VectorXd::Constant(6, 2e-5), &log_.q);
    AddNoise(&random_, relative * ColumnRms(log_.tau), &log_.tau);
  }
  // The worst error of a parameter, relative to the largest parameter.
  double Error(const LinearCalibration& result) const {
    return (result.x - X_).cwiseAbs().maxCoeff() / X_.cwiseAbs().maxCoeff();
  }
  // rms of errors in units of standard deviations.
  double Normalised(const LinearCalibration& result,
                    const VectorXd& stddev) const {
    const VectorXd z = (result.x - X_).cwiseQuotient(stddev);
    return z.norm() / std::sqrt(static_cast<double>(z.size()));
  }
  // Calibrates the log before and after `spoil`, after with both losses; errors
  // in units of what is claimed for the clean log.
  template <class Spoil>
  void ExpectResists(const Spoil& spoil, double squared_at_least,
                     double huber_at_most, bool with_rates = false) {
    const VectorXd clean =
        CalibrateLogs(robot_, {log_}, options_, with_rates).stddev;
    spoil();
    options_.loss = RobustLoss::kSquared;
    const double squared =
        Normalised(CalibrateLogs(robot_, {log_}, options_, with_rates), clean);
    options_.loss = RobustLoss::kHuber;
    const LinearCalibration robust =
        CalibrateLogs(robot_, {log_}, options_, with_rates);
    const double huber = Normalised(robust, clean);
    std::printf("errors over clean stddev: squared %.3g, Huber %.3g\n", squared,
                huber);
    EXPECT_GT(squared, squared_at_least);
    EXPECT_LT(huber, huber_at_most);
    for (const long outliers : robust.outliers) EXPECT_GT(outliers, 5);
  }
  void SpoilSamples(double share) {
    const VectorXd rms = ColumnRms(log_.tau);
    for (int k = 0; k < log_.size(); ++k) {
      for (int j = 0; j < 6; ++j) {
        if (Uniform(&random_, 0, 1) < share) log_.tau(k, j) += 5 * rms[j];
      }
    }
  }

  std::mt19937_64 random_{41};
  Robot robot_;
  VectorXd offset_, X_;
  Log log_;
  LinearCalibrationOptions options_;
};

TEST_F(Ur5, ExactDataByEveryModel) {
  options_.bandwidth_hz = 0;
  for (const auto model : {Identification::kWeak, Identification::kDifferential,
                           Identification::kIntegral}) {
    options_.identification = model;
    const LinearCalibration result =
        CalibrateLogs(robot_, {log_}, options_, true);
    ASSERT_TRUE(result.solved) << result.reason;
    EXPECT_EQ(result.identifiability.batch_rank, X_.size());
    EXPECT_TRUE(result.unpowered.empty());
    const double tolerance =
        model == Identification::kDifferential ? 1e-10 : 1e-3;
    EXPECT_LT(Error(result), tolerance) << static_cast<int>(model);
    std::printf("model %d: error %.2g, residual %.2g %%\n",
                static_cast<int>(model), Error(result),
                result.training->moving().stacked_percent);
  }
}

TEST_F(Ur5, ErrorsAreAsLargeAsClaimed) {
  AddSensorNoise(.01);
  for (const auto loss : {RobustLoss::kHuber, RobustLoss::kSquared}) {
    options_.loss = loss;
    const LinearCalibration result = CalibrateLogs(robot_, {log_}, options_);
    ASSERT_TRUE(result.solved) << result.reason;
    const double normalised = Normalised(result, result.stddev);
    std::printf("errors over claimed stddev: %.3f\n", normalised);
    EXPECT_GT(normalised, .75);
    EXPECT_LT(normalised, 1.5);
  }
}

TEST_F(Ur5, FindsTheTransitionItself) {
  AddSensorNoise(.01);
  options_.transition.reset();
  const LinearCalibration result = CalibrateLogs(robot_, {log_}, options_);
  ASSERT_EQ(result.transitions.size(), 6u);
  for (const CoulombTransition& t : result.transitions) {
    EXPECT_EQ(t.law, Law::kVelocity);
    EXPECT_NEAR(std::log(t.width / .05), 0, .6);
  }
}

// Bursts over 2 % of the time, five times the torque.
TEST_F(Ur5, HuberResistsBursts) {
  AddSensorNoise(.01);
  const auto spoil = [&] {
    const VectorXd rms = ColumnRms(log_.tau);
    for (int j = 0; j < 6; ++j) {
      for (const int begin : {700 + 150 * j, 4000 + 100 * j}) {
        log_.tau.col(j).segment(begin, 60).array() += 5 * rms[j];
      }
    }
  };
  ExpectResists(spoil, 100, 1.3);
}

// Single samples, 2 % of them: for the differential model each is one row.
TEST_F(Ur5, HuberResistsSingleSamplesInTheDifferentialModel) {
  AddNoise(&random_, .01 * ColumnRms(log_.tau), &log_.tau);
  options_.bandwidth_hz = 0;
  options_.identification = Identification::kDifferential;
  ExpectResists([&] { SpoilSamples(.02); }, 100, 1.5, true);
}

// Every window of the weak form holds some of these: they are taken out sample
// by sample, before. Squared leaves the data as they are.
TEST_F(Ur5, WeakFormResistsScatteredSamples) {
  AddSensorNoise(.01);
  const VectorXd clean = CalibrateLogs(robot_, {log_}, options_).stddev;
  SpoilSamples(.05);
  const LinearCalibration spoiled = CalibrateLogs(robot_, {log_}, options_);
  EXPECT_LT(Normalised(spoiled, clean), 1.5);
  options_.loss = RobustLoss::kSquared;
  EXPECT_GT(Normalised(CalibrateLogs(robot_, {log_}, options_), clean), 100);
}

}  // namespace armcal::calibration_test
