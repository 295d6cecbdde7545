#include "tests/blind/residual_noise.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace armcal {

ResidualNoise ResidualNoise::Fit(const Eigen::VectorXd& series) {
  const long n = series.size();
  Eigen::Vector4d r;
  for (int lag = 0; lag <= kOrder; ++lag) {
    r[lag] = series.head(n - lag).dot(series.tail(n - lag)) / n;
  }
  Eigen::Matrix3d R;
  for (int i = 0; i < kOrder; ++i) {
    for (int j = 0; j < kOrder; ++j) R(i, j) = r[std::abs(i - j)];
  }
  ResidualNoise noise;
  noise.a = R.ldlt().solve(r.tail<3>());
  noise.sigma = std::sqrt(r[0] - noise.a.dot(r.tail<3>()));
  return noise;
}

Eigen::MatrixXd ResidualNoise::Whiten(const Eigen::MatrixXd& x) const {
  const long rows = x.rows() - kOrder;
  Eigen::MatrixXd white = x.bottomRows(rows);
  for (int lag = 1; lag <= kOrder; ++lag) {
    white -= a[lag - 1] * x.middleRows(kOrder - lag, rows);
  }
  return white / sigma;
}

}  // namespace armcal
