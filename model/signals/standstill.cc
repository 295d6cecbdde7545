#include "model/signals/standstill.h"

#include <algorithm>
#include <cmath>

namespace armcal {

Eigen::MatrixXd MeanVelocity(const Eigen::MatrixXd& q, double dt) {
  const Eigen::Index n = q.rows();
  const Eigen::Index half = std::max<Eigen::Index>(
      1, static_cast<Eigen::Index>(std::lround(kStandstillMeanTime / 2 / dt)));
  Eigen::MatrixXd v(n, q.cols());
  for (Eigen::Index j = 0; j < q.cols(); ++j) {
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::Index a = std::max<Eigen::Index>(0, k - half);
      const Eigen::Index b = std::min(n - 1, k + half);
      v(k, j) = (q(b, j) - q(a, j)) /
                (dt * static_cast<double>(std::max<Eigen::Index>(1, b - a)));
    }
  }
  return v;
}

Eigen::Array<bool, Eigen::Dynamic, 1> FindStandstill(
    const Eigen::MatrixXd& velocity, double dt, int reach, double speed) {
  const int n = static_cast<int>(velocity.rows());
  const int least =
      std::max(1, static_cast<int>(std::ceil(kStandstillTime / dt - 1e-9)));
  Eigen::Array<bool, Eigen::Dynamic, 1> standstill =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(n, false);
  const Eigen::Array<bool, Eigen::Dynamic, 1> moves =
      (velocity.array().abs() >= speed).rowwise().any();
  int begin = 0;
  for (int k = 0; k <= n; ++k) {
    if (k < n && !moves[k]) continue;
    const int first = begin == 0 ? 0 : std::max(0, begin - reach);
    const int last = std::min(n, k + reach);
    if (k > begin && last - first >= least) {
      standstill.segment(first, last - first) = true;
    }
    begin = k + 1;
  }
  return standstill;
}

}  // namespace armcal
