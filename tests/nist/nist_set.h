#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace armcal {

// A set of NIST's Statistical Reference Datasets for nonlinear regression:
// measured data, two starts, and values certified to 11 digits from
// computations in 500 (https://www.itl.nist.gov/div898/strd, public domain).
struct NistSet {
  std::string name;
  Eigen::VectorXd y;
  Eigen::MatrixXd x;                   // observations x predictors
  std::vector<Eigen::VectorXd> start;  // far, near
  Eigen::VectorXd value, stddev;       // of the parameters
};

// The names of the 27 sets.
std::vector<std::string> NistNames();

// The set of that name in a folder that fetch.py has filled. Throws
// std::runtime_error where the text is not what NIST describes.
NistSet ReadNistSet(const std::string& folder, const std::string& name);

// Model less observation, all as one block of parameters.
class NistResidual : public ceres::CostFunction {
 public:
  explicit NistResidual(const NistSet& set);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const NistSet& set_;
};

}  // namespace armcal
