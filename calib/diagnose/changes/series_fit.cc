#include "calib/diagnose/changes/series_fit.h"

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Of x: parameters may make ten times a joint's torque.
constexpr double kOpen = 10;
// A scatter that were none could not grow again.
constexpr double kLeastScatter = .01;  // of the usual

MatrixXd Directions(const std::vector<ScatterComponent>& components, int size) {
  MatrixXd all(size, components.size());
  for (size_t k = 0; k < components.size(); ++k) {
    all.col(static_cast<Eigen::Index>(k)) = components[k].direction;
  }
  return all;
}

double LogDeterminant(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

SeriesFit::SeriesFit(const std::vector<LogEquations>& logs,
                     const std::vector<ScatterComponent>& components,
                     const Scatter& scatter, const LogColumns& columns,
                     const VectorXd& prior)
    : scatter_(scatter), parameters_(static_cast<int>(logs[0].root.cols())) {
  const Eigen::Index size = parameters_ + prior.size();
  const MatrixXd spread =
      Directions(components, parameters_) * scatter.stddev.asDiagonal();
  VectorXd precision(size);
  precision << VectorXd::Constant(parameters_, 1 / kOpen / kOpen),
      prior.array().square().inverse().matrix();
  MatrixXd normal = precision.asDiagonal();
  sums_ = VectorXd::Zero(size);
  for (size_t l = 0; l < logs.size(); ++l) {
    const MatrixXd scattered = logs[l].root * spread;
    MatrixXd covariance = scattered * scattered.transpose();
    covariance.diagonal().array() += scatter.inflation;
    Log log{Eigen::LLT<MatrixXd>(covariance), {}, {}};
    log.design.resize(logs[l].root.rows(), size);
    log.design << logs[l].root, columns[l];
    log.factor.matrixL().solveInPlace(log.design);
    log.right = log.factor.matrixL().solve(logs[l].right);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(log.design.transpose());
    sums_ += log.design.transpose() * log.right;
    log_evidence_ -=
        .5 * (LogDeterminant(log.factor) + log.right.squaredNorm());
    logs_.push_back(std::move(log));
  }
  normal_.compute(normal);
  value_ = normal_.solve(sums_);
  log_evidence_ += .5 * (sums_.dot(value_) - LogDeterminant(normal_) +
                         precision.array().log().sum());
}

ColumnSums SeriesFit::Sums(const LogColumns& columns) const {
  ColumnSums sums;
  for (size_t l = 0; l < logs_.size(); ++l) {
    MatrixXd whitened = columns[l];
    logs_[l].factor.matrixL().solveInPlace(whitened);
    sums.own.push_back(whitened.transpose() * whitened);
    sums.mixed.push_back(whitened.transpose() * logs_[l].design);
    sums.score.push_back(whitened.transpose() * logs_[l].right);
  }
  return sums;
}

Gain SeriesFit::Add(const ColumnSums& sums, const VectorXd& weight,
                    const VectorXd& prior) const {
  const Eigen::Index p = prior.size();
  MatrixXd own = MatrixXd::Zero(p, p), mixed = MatrixXd::Zero(p, sums_.size());
  VectorXd score = VectorXd::Zero(p);
  for (size_t l = 0; l < logs_.size(); ++l) {
    const double w = weight[static_cast<Eigen::Index>(l)];
    if (w == 0) continue;
    own += w * w * sums.own[l];
    mixed += w * sums.mixed[l];
    score += w * sums.score[l];
  }
  // In units of the prior: information I + A, score y.
  const MatrixXd reduced = normal_.matrixL().solve(mixed.transpose());
  MatrixXd A = own - reduced.transpose() * reduced;
  A = prior.asDiagonal() * A * prior.asDiagonal();
  A.diagonal().array() += 1;
  const VectorXd y = prior.cwiseProduct(score - mixed * value_);
  const Eigen::LLT<MatrixXd> factor(A);
  const VectorXd z = factor.solve(y);
  return {.5 * (y.dot(z) - LogDeterminant(factor)), prior.cwiseProduct(z),
          prior.asDiagonal() * factor.solve(MatrixXd(prior.asDiagonal()))};
}

MatrixXd SeriesFit::Covariance() const {
  return normal_.solve(MatrixXd::Identity(value_.size(), value_.size()));
}

double SeriesFit::Inflation() const {
  double errors = 0, expected = 0;
  for (const Log& log : logs_) {
    const VectorXd left = log.right - log.design * value_;
    const MatrixXd inverse = log.factor.matrixL().solve(
        MatrixXd::Identity(left.size(), left.size()));
    errors += (inverse.transpose() * left).squaredNorm();
    expected +=
        inverse.squaredNorm() -
        normal_.matrixL().solve(log.design.transpose() * inverse).squaredNorm();
  }
  if (!(expected > 0)) return scatter_.inflation;
  return std::max(1., scatter_.inflation * std::sqrt(errors / expected));
}

Scatter SeriesFit::Better(const std::vector<ScatterComponent>& components,
                          bool fit_inflation) const {
  const MatrixXd directions = Directions(components, parameters_);
  const auto size = static_cast<Eigen::Index>(components.size());
  // Squared scores of the components and what they are expected to be.
  Eigen::ArrayXd found = Eigen::ArrayXd::Zero(size), expected = found;
  for (const Log& log : logs_) {
    const auto R = log.design.leftCols(parameters_);
    const VectorXd left = log.right - log.design * value_;
    const MatrixXd square = R.transpose() * log.design;
    const MatrixXd fitted = normal_.matrixL().solve(square.transpose());
    const MatrixXd information =
        square.leftCols(parameters_) - fitted.transpose() * fitted;
    found += (directions.transpose() * (R.transpose() * left)).array().square();
    expected += (information * directions)
                    .cwiseProduct(directions)
                    .colwise()
                    .sum()
                    .transpose()
                    .array();
  }
  Scatter better = scatter_;
  for (Eigen::Index k = 0; k < size; ++k) {
    const double variance = std::pow(scatter_.stddev[k], 2);
    const double usual = std::pow(components[k].usual, 2);
    const double slope =
        std::max(expected[k], 0.) +
        (kScatterFreedom + 1) / (kScatterFreedom * usual + variance);
    better.stddev[k] =
        std::max(kLeastScatter * components[k].usual,
                 std::sqrt(variance * std::sqrt(found[k] / slope)));
  }
  if (fit_inflation) better.inflation = Inflation();
  return better;
}

Scatter FitScatter(const std::vector<LogEquations>& logs,
                   const std::vector<ScatterComponent>& components,
                   const LogColumns& columns, const VectorXd& prior,
                   const Scatter& start, bool fit_inflation) {
  constexpr int kMostSteps = 100;
  constexpr double kSettled = .003;  // relative to the usual scatter
  Scatter scatter = start;
  for (int step = 0; step < kMostSteps; ++step) {
    const Scatter last = scatter;
    scatter = SeriesFit(logs, components, last, columns, prior)
                  .Better(components, fit_inflation);
    double moved = std::abs(scatter.inflation / last.inflation - 1);
    for (size_t k = 0; k < components.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      moved = std::max(moved, std::abs(scatter.stddev[i] - last.stddev[i]) /
                                  (last.stddev[i] + .1 * components[k].usual));
    }
    if (moved < kSettled) break;
  }
  return scatter;
}

}  // namespace armcal
