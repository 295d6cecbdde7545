#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// What data and a prior leave open of parameters. It is decomposed in
// coordinates in which the prior is 1, so that directions that only the prior
// determines stay exact beside data that are a million times sharper, and no
// variance comes out negative.
class Posterior {
 public:
  // Information of the data and of the prior, of all parameters; those not
  // `kept` are known, their rows and columns of results 0. Where there is no
  // prior, one of 10^4 times a parameter's deviation alone stands for it.
  Posterior(const Eigen::MatrixXd& data, const Eigen::MatrixXd& prior,
            const std::vector<int>& kept);

  // (data + prior)^-1
  Eigen::MatrixXd Gain() const;
  // Gain() scores Gain()'
  Eigen::MatrixXd Sandwich(const Eigen::MatrixXd& scores) const;

 private:
  Eigen::MatrixXd T_;  // parameters x directions
  Eigen::VectorXd shrink_;
};

}  // namespace armcal
