#include "model/signals/uneven_differences.h"

#include <glog/logging.h>

#include <algorithm>

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Derivatives of Lagrange's polynomials of these times at the one of them.
VectorXd Weights(const VectorXd& t, Index at) {
  VectorXd weights(t.size());
  double own = 0;
  for (Index k = 0; k < t.size(); ++k) {
    if (k == at) continue;
    own += 1 / (t[at] - t[k]);
    double weight = 1 / (t[k] - t[at]);
    for (Index m = 0; m < t.size(); ++m) {
      if (m != k && m != at) weight *= (t[at] - t[m]) / (t[k] - t[m]);
    }
    weights[k] = weight;
  }
  weights[at] = own;
  return weights;
}

}  // namespace

Eigen::MatrixXd DifferentiateUneven(const VectorXd& t, const Eigen::MatrixXd& x,
                                    int points) {
  CHECK_EQ(t.size(), x.rows());
  const Index used = std::min<Index>(points, t.size());
  Eigen::MatrixXd rate(x.rows(), x.cols());
  for (Index row = 0; row < t.size(); ++row) {
    const Index first = std::clamp<Index>(row - used / 2, 0, t.size() - used);
    rate.row(row) = Weights(t.segment(first, used), row - first).transpose() *
                    x.middleRows(first, used);
  }
  return rate;
}

}  // namespace armcal
