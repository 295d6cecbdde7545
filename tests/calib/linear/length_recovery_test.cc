#include "calib/linear/length_recovery.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>
#include <random>

#include "calib/linear/solution.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::length_recovery_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A log of an arm whose axes' directions only are known, as a factor.
struct Lengths {
  Lengths(const std::string& name, GeometryKnowledge geometry,
          double relative_noise)
      : robot(SampleRobot(name)), parameters(Make(&robot, geometry)) {
    std::mt19937_64 random(12);
    const int n = parameters.num_joints();
    Log log = RecordMotion(RandomMultisine(&random, n, 1.2), 10, .002);
    AddTorque(robot, &log);
    const VectorXd rms = ColumnRms(log.tau);
    sigma = std::max(relative_noise, 1e-12) * rms;
    if (relative_noise > 0) AddNoise(&random, sigma, &log.tau);
    BlockTriangularFactor factor(parameters);
    Regressor regressor = parameters.MakeRegressor();
    MatrixXd U;
    for (int k = 0; k < log.size(); ++k) {
      regressor.Differential(log.q.row(k), log.qd.row(k), log.qdd.row(k),
                             VectorXd(), &U);
      for (int i = 0; i < n; ++i) factor.Add(i, U.row(i), log.tau(k, i));
    }
    solution =
        SolveWeighted(factor, sigma,
                      MakeReferenceScale(parameters, 1, .5, 1, rms,
                                         VectorXd::Zero(parameters.size())));
    covariance = solution.IndependentCovariance(factor, sigma);
  }
  static ModelParameters Make(Robot* robot, GeometryKnowledge geometry) {
    std::mt19937_64 random(11);
    SetRandomInertials(&random, robot);
    ModelParameters::Options options;
    options.geometry = geometry;
    return ModelParameters(*robot, options);
  }
  std::map<std::string, RecoveredLength> Recover(const VectorXd& x) const {
    std::map<std::string, RecoveredLength> lengths;
    for (const RecoveredLength& l : RecoverLengths(
             parameters, x, covariance, covariance, solution.identifiable)) {
      lengths.emplace(l.symbol, l);
    }
    return lengths;
  }

  Robot robot;
  ModelParameters parameters;
  VectorXd sigma;
  LinearSolution solution;
  MatrixXd covariance;
};

void ExpectExact(const std::string& name, GeometryKnowledge geometry,
                 const std::map<std::string, double>& truth) {
  const Lengths c(name, geometry, 0);
  const auto lengths = c.Recover(c.solution.x);
  for (const auto& [symbol, value] : truth) {
    ASSERT_EQ(lengths.count(symbol), 1u) << name << " " << symbol;
    const RecoveredLength& l = lengths.at(symbol);
    EXPECT_NEAR(l.value, value, 1e-8) << name << " " << symbol;
    EXPECT_EQ(l.nominal, value);
    EXPECT_TRUE(l.identifiable) << name << " " << symbol;
    EXPECT_LT(l.stddev, 1e-6);
  }
  for (const auto& [symbol, l] : lengths) {
    // No other length may claim to be known and be wrong.
    if (l.identifiable) {
      EXPECT_NEAR(l.value, l.nominal, 1e-8) << symbol;
    }
  }
}

const std::map<std::string, double> kPuma = {
    {"a2", .4318}, {"a3", .0203}, {"d3", .15005}, {"d4", .4318}};
const std::map<std::string, double> kUr5 = {
    {"a2", -.425}, {"a3", -.39225}, {"d4", .10915}, {"d5", .09465}};
const std::map<std::string, double> kPanda = {
    {"a3", .0825}, {"d3", .316}, {"a4", -.0825}, {"d5", .384}, {"a6", .088}};

TEST(LengthRecovery, NonzeroLengthsFromExactTorque) {
  ExpectExact("PUMA560 6R", GeometryKnowledge::kNonzeroLengths, kPuma);
  ExpectExact("UR5 6R", GeometryKnowledge::kNonzeroLengths, kUr5);
  ExpectExact("Panda 7R", GeometryKnowledge::kNonzeroLengths, kPanda);
}

TEST(LengthRecovery, AllLengthsFromExactTorque) {
  // d2 and d3 lie along parallel axes: only their sum is seen.
  std::map<std::string, double> puma = kPuma;
  puma.erase("d3");
  ExpectExact("PUMA560 6R", GeometryKnowledge::kAllLengths, puma);
  ExpectExact("UR5 6R", GeometryKnowledge::kAllLengths,
              {{"a2", -.425}, {"a3", -.39225}, {"d5", .09465}});
  ExpectExact("Panda 7R", GeometryKnowledge::kAllLengths, kPanda);
}

// Exact torque of the true arm, lengths from the structure of an arm with other
// ones: sums are the truth's, and shared so that all change as little as can
// be.
TEST(LengthRecovery, SumsOfLengthsNearestToTheFile) {
  const Lengths truth("UR5 6R", GeometryKnowledge::kAllLengths, 0);
  Robot file = truth.robot;
  for (Link& link : file.links) link.X_ML.translation() *= 1.08;
  ModelParameters::Options options;
  options.geometry = GeometryKnowledge::kAllLengths;
  const ModelParameters parameters(file, options);
  ASSERT_EQ(parameters.size(), truth.parameters.size());
  const double change = -.08 * .10915 / 3;
  const std::map<std::string, double> expected = {
      {"d1", 1.08 * .089159},
      {"d2", change},
      {"d3", change},
      {"d4", 1.08 * .10915 + change}};
  for (const RecoveredLength& l : RecoverLengths(
           parameters, parameters.Values(truth.robot), truth.covariance,
           truth.covariance, truth.solution.identifiable)) {
    EXPECT_EQ(l.identifiable, expected.count(l.symbol) == 0) << l.symbol;
    if (l.identifiable) continue;
    EXPECT_NEAR(l.value, expected.at(l.symbol), 1e-7) << l.symbol;
  }
}

TEST(LengthRecovery, NothingToRecover) {
  const Lengths c("PUMA560 6R", GeometryKnowledge::kKnown, 0);
  EXPECT_TRUE(c.Recover(c.solution.x).empty());
}

// Without gravity along them, horizontal lengths appear in products only.
TEST(LengthRecovery, HorizontalLengthsAreProductsOnly) {
  for (const char* name : {"SCARA RRPR", "2R planar (horizontal)"}) {
    const Lengths c(name, GeometryKnowledge::kNonzeroLengths, 0);
    for (const auto& [symbol, l] : c.Recover(c.solution.x)) {
      EXPECT_FALSE(l.identifiable) << name << " " << symbol;
      EXPECT_EQ(l.value, l.nominal) << name << " " << symbol;
    }
  }
}

// Of the SCARA's lengths, .4 and .3 m, the ratio is seen, since both multiply
// the same moment. A file with another ratio gets the nearest of that ratio,
// from wherever errors make the search start.
TEST(LengthRecovery, RatioOfLengthsNearestToTheFile) {
  const Lengths c("SCARA RRPR", GeometryKnowledge::kNonzeroLengths, .01);
  Robot file = c.robot;
  file.links[0].X_ML.translation() *= 1.1;
  ModelParameters::Options options;
  options.geometry = GeometryKnowledge::kNonzeroLengths;
  const ModelParameters parameters(file, options);
  const MatrixXd L = Eigen::LLT<MatrixXd>(c.covariance).matrixL();
  const double nearest = (.44 * .4 + .3 * .3) / .25;
  std::mt19937_64 random(13);
  std::normal_distribution<double> normal;
  for (int draw = 0; draw < 30; ++draw) {
    VectorXd error(L.cols());
    for (double& e : error) e = draw > 0 ? normal(random) : 0;
    const auto lengths =
        RecoverLengths(parameters, c.parameters.Values(c.robot) + L * error,
                       c.covariance, c.covariance, c.solution.identifiable);
    ASSERT_EQ(lengths.size(), 2u);
    const Eigen::Vector2d value(lengths[0].value, lengths[1].value);
    const Eigen::Vector2d change = value - Eigen::Vector2d(.44, .3);
    EXPECT_NEAR(value.dot(change), 0, 1e-9) << draw;
    EXPECT_NEAR(value[0] / value[1], .4 / .3, draw > 0 ? .01 : 1e-7);
    if (draw == 0) {
      EXPECT_NEAR(value[0], .4 * nearest, 1e-7);
    }
  }
}

// 10 s at 500 Hz with 1 % torque noise; the Cramer-Rao bound of lengths in a
// fit of links is .28, .43, 1.21, .62 mm on another motion.
TEST(LengthRecovery, PumaWithNoise) {
  const Lengths c("PUMA560 6R", GeometryKnowledge::kNonzeroLengths, .01);
  const auto lengths = c.Recover(c.solution.x);
  for (const auto& [symbol, value] : kPuma) {
    const RecoveredLength& l = lengths.at(symbol);
    std::printf("%s: stddev %.3f mm, error %.3f mm\n", symbol.c_str(),
                1e3 * l.stddev, 1e3 * (l.value - value));
    EXPECT_LT(std::abs(l.value - value), 4 * l.stddev) << symbol;
  }
  EXPECT_GT(lengths.at("a2").stddev, .1e-3);
  EXPECT_LT(lengths.at("a2").stddev, .4e-3);
}

// Intervals of 95 % over draws of X from its own covariance.
TEST(LengthRecovery, IntervalsCover) {
  const Lengths c("PUMA560 6R", GeometryKnowledge::kNonzeroLengths, .01);
  const VectorXd X = c.parameters.Values(c.robot);
  const MatrixXd root = c.covariance.llt().matrixL();
  std::mt19937_64 random(13);
  constexpr int kRuns = 400;
  std::map<std::string, int> covered;
  std::map<std::string, double> squares;
  for (int run = 0; run < kRuns; ++run) {
    MatrixXd z = MatrixXd::Zero(1, X.size());
    AddNoise(&random, VectorXd::Ones(X.size()), &z);
    for (const auto& [symbol, l] : c.Recover(X + root * z.transpose())) {
      const double error = (l.value - l.nominal) / l.stddev;
      covered[symbol] += std::abs(error) < 1.96;
      squares[symbol] += error * error / kRuns;
    }
  }
  for (const auto& [symbol, value] : kPuma) {
    std::printf("%s: coverage %.1f %%, true over claimed stddev %.3f\n",
                symbol.c_str(), 100. * covered[symbol] / kRuns,
                std::sqrt(squares[symbol]));
    EXPECT_NEAR(100. * covered[symbol] / kRuns, 95, 3) << symbol;
    EXPECT_NEAR(std::sqrt(squares[symbol]), 1, .08) << symbol;
  }
}

}  // namespace armcal::length_recovery_test
