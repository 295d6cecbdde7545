#include "calib/diagnose/changes/series_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::series_fit_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Logs of two parameters, each with equations of its own.
std::vector<LogEquations> Logs(int count, double scatter,
                               std::mt19937_64* random,
                               VectorXd* first = nullptr) {
  std::vector<LogEquations> logs;
  for (int l = 0; l < count; ++l) {
    LogEquations log{MatrixXd(3, 2), VectorXd(3)};
    VectorXd x(2);
    x << .4 + scatter * Normal(random), -.2;
    if (first != nullptr) (*first)[l] = x[0];
    for (int r = 0; r < 3; ++r) {
      for (int k = 0; k < 2; ++k) log.root(r, k) = 10 * Normal(random);
    }
    log.right = log.root * x;
    for (double& y : log.right) y += Normal(random);
    logs.push_back(log);
  }
  return logs;
}

const std::vector<ScatterComponent> kComponents = {{VectorXd::Unit(2, 0), .1},
                                                   {VectorXd::Unit(2, 1), .1}};

Scatter SomeScatter() {
  Scatter scatter;
  scatter.stddev = (VectorXd(2) << .3, .05).finished();
  scatter.inflation = 1.5;
  return scatter;
}

LogColumns NoColumns(const std::vector<LogEquations>& logs) {
  return LogColumns(logs.size(), MatrixXd(logs[0].root.rows(), 0));
}

// All right sides are one normal vector, whose covariance is put together
// here: prior of x (10), scatter, columns, errors.
double LogDensity(const std::vector<LogEquations>& logs, const Scatter& scatter,
                  const LogColumns& columns, const VectorXd& weight,
                  const VectorXd& prior) {
  const Eigen::Index rows = logs[0].root.rows();
  const auto count = static_cast<Eigen::Index>(logs.size());
  MatrixXd design(rows * count, 2), extra(rows * count, prior.size());
  VectorXd y(rows * count);
  MatrixXd V = MatrixXd::Zero(rows * count, rows * count);
  for (Eigen::Index l = 0; l < count; ++l) {
    design.middleRows(l * rows, rows) = logs[l].root;
    extra.middleRows(l * rows, rows) = weight[l] * columns[l];
    y.segment(l * rows, rows) = logs[l].right;
    V.block(l * rows, l * rows, rows, rows) =
        scatter.inflation * MatrixXd::Identity(rows, rows) +
        logs[l].root * VectorXd(scatter.stddev.array().square()).asDiagonal() *
            logs[l].root.transpose();
  }
  V += 100 * design * design.transpose();
  V +=
      extra * VectorXd(prior.array().square()).asDiagonal() * extra.transpose();
  const Eigen::LLT<MatrixXd> factor(V);
  return -.5 * y.dot(factor.solve(y)) -
         factor.matrixLLT().diagonal().array().log().sum();
}

TEST(SeriesFit, EvidenceIsTheNormalDensityOfAllLogs) {
  std::mt19937_64 random(1);
  const auto logs = Logs(5, .3, &random);
  const LogColumns none = NoColumns(logs);
  const SeriesFit fit(logs, kComponents, SomeScatter(), none, VectorXd());
  EXPECT_NEAR(
      fit.log_evidence(),
      LogDensity(logs, SomeScatter(), none, VectorXd::Ones(5), VectorXd()),
      1e-8);
}

TEST(SeriesFit, GainIsTheRatioOfDensitiesWithAndWithoutColumns) {
  std::mt19937_64 random(2);
  const auto logs = Logs(5, .3, &random);
  LogColumns columns;
  for (const LogEquations& log : logs) columns.push_back(log.root.col(0));
  const VectorXd weight = (VectorXd(5) << 0, 0, .5, 1, 1).finished();
  const VectorXd prior = VectorXd::Constant(1, .7);
  const LogColumns none = NoColumns(logs);
  const SeriesFit fit(logs, kComponents, SomeScatter(), none, VectorXd());
  const Gain gain = fit.Add(fit.Sums(columns), weight, prior);
  EXPECT_NEAR(gain.log_bayes_factor,
              LogDensity(logs, SomeScatter(), columns, weight, prior) -
                  LogDensity(logs, SomeScatter(), none, weight, VectorXd()),
              1e-8);
  // And the same as fitting them from the start.
  LogColumns weighed = columns;
  for (int l = 0; l < 5; ++l) weighed[l] *= weight[l];
  const SeriesFit both(logs, kComponents, SomeScatter(), weighed, prior);
  EXPECT_NEAR(gain.value[0], both.value()[2], 1e-9);
  EXPECT_NEAR(gain.covariance(0, 0), both.Covariance()(2, 2), 1e-9);
}

// Of many logs the scatter is what was drawn, and the parameter without any has
// next to none.
TEST(SeriesFit, ScatterIsWhatLogsDifferBy) {
  std::mt19937_64 random(3);
  VectorXd drawn(400);
  const auto logs = Logs(400, .3, &random, &drawn);
  const double stddev =
      std::sqrt((drawn.array() - drawn.mean()).square().sum() / 399);
  Scatter start;
  start.stddev = VectorXd::Constant(2, .05);
  const Scatter found =
      FitScatter(logs, kComponents, NoColumns(logs), VectorXd(), start, true);
  EXPECT_NEAR(found.stddev[0], stddev, .01);
  EXPECT_NEAR(stddev, .3, .04);  // .3 / sqrt(800) is .011
  EXPECT_LT(found.stddev[1], .03);
  EXPECT_NEAR(found.inflation, 1, .15);
}

}  // namespace armcal::series_fit_test
