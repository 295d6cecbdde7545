#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace armcal {

// What a log tells of the parameters x: root x = right with independent errors
// of variance 1. Parameters are in units that make about a joint's torque.
struct LogEquations {
  Eigen::MatrixXd root;
  Eigen::VectorXd right;
};

// Something that differs from log to log without being a change: parameters are
// off by `direction` times a number of mean 0 that each log has anew. Its
// standard deviation is estimated; `usual` is what is thought of it before.
struct ScatterComponent {
  Eigen::VectorXd direction;
  double usual;
  bool is_friction = false;  // which differs from day to day by itself
};

// The prior of a component's standard deviation is half of Student's t with so
// many degrees of freedom and the scale `usual` (Gelman 2006): sizes up to that
// are alike, several times that are rare. With one degree (Cauchy's) a change
// that only four logs tell never beats days that could be anything.
inline constexpr double kScatterFreedom = 3;

struct Scatter {
  Eigen::VectorXd stddev;  // of each component
  // Variance of a log's errors over that of its equations: what no model of
  // the robot explains is another with other motions; at least 1.
  double inflation = 1;
};

// A column of each log's equations, times an unknown number that is the same
// for all logs: root x + column * number = right.
using LogColumns = std::vector<Eigen::MatrixXd>;

// Of each log, the products of further columns, whitened: with themselves, with
// the columns of the fit and with the right sides.
struct ColumnSums {
  std::vector<Eigen::MatrixXd> own, mixed;
  std::vector<Eigen::VectorXd> score;
};

// What columns given a fit explain.
struct Gain {
  double log_bayes_factor = 0;  // of the fit with them over the one without
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;
};

// The linear mixed model of a series of logs,
//   right_l = root_l (x + S_l) + columns_l b + e_l,
// S_l ~ N(0, sum_k stddev_k^2 direction_k direction_k'), e_l ~ N(0, inflation),
// x and b normal: integrals over all of these are closed forms.
class SeriesFit {
 public:
  // prior: standard deviations of the numbers that `columns` are times of.
  SeriesFit(const std::vector<LogEquations>& logs,
            const std::vector<ScatterComponent>& components,
            const Scatter& scatter, const LogColumns& columns,
            const Eigen::VectorXd& prior);

  // Of all right sides, up to a constant of the logs.
  double log_evidence() const { return log_evidence_; }
  // What each log says of further columns, given itself and the fit's own.
  ColumnSums Sums(const LogColumns& columns) const;
  // The fit with further columns, log l's times weight[l], with normal priors
  // of these standard deviations.
  Gain Add(const ColumnSums& sums, const Eigen::VectorXd& weight,
           const Eigen::VectorXd& prior) const;
  // x, then the numbers of `columns`.
  const Eigen::VectorXd& value() const { return value_; }
  Eigen::MatrixXd Covariance() const;

  // The scatter that is likelier: a step of the MM algorithm of Zhou, Hu, Zhou
  // and Lange (2019, J. Comput. Graph. Stat. 28) for variance components.
  // The inflation stays unless it is to be fitted.
  Scatter Better(const std::vector<ScatterComponent>& components,
                 bool fit_inflation) const;

 private:
  struct Log {
    Eigen::LLT<Eigen::MatrixXd> factor;  // of the covariance of right
    Eigen::MatrixXd design;              // whitened [root, columns]
    Eigen::VectorXd right;               // whitened
  };

  double Inflation() const;

  Scatter scatter_;
  int parameters_ = 0;
  std::vector<Log> logs_;
  Eigen::LLT<Eigen::MatrixXd> normal_;
  Eigen::VectorXd value_;
  Eigen::VectorXd sums_;  // right side of the normal equations
  double log_evidence_ = 0;
};

// The scatter of largest posterior density given these columns, from `start`.
Scatter FitScatter(const std::vector<LogEquations>& logs,
                   const std::vector<ScatterComponent>& components,
                   const LogColumns& columns, const Eigen::VectorXd& prior,
                   const Scatter& start, bool fit_inflation);

}  // namespace armcal
