#include "calib/gap_inflation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double Inflation(const GapScreen& screen, const GapRows& rows,
                 const GapCandidate& candidate, const GapScreen::Fit& fit) {
  constexpr double kBlock = 2;  // s
  const int size = static_cast<int>(candidate.columns.size());
  MatrixXd G(size, size);
  for (int a = 0; a < size; ++a) {
    for (int b = 0; b < size; ++b) {
      G(a, b) = screen.G()(candidate.columns[a], candidate.columns[b]);
    }
    G(a, a) += 1e-9 * screen.raw(candidate.columns[a]);
  }
  std::map<std::pair<int, long>, VectorXd> blocks;
  for (int j = 0; j < rows.num_joints(); ++j) {
    const std::vector<int> samples = rows.SampleOfRow(j);
    const VectorXd residual = screen.Residual(j, fit);
    MatrixXd columns(residual.size(), size);
    for (int a = 0; a < size; ++a) {
      columns.col(a) = screen.Projected(candidate.columns[a], j);
    }
    int s = 0;
    for (size_t k = 0; k < samples.size(); ++k) {
      while (samples[k] >= rows.thin_begin(s + 1)) ++s;
      const long block =
          std::lround(std::floor(rows.thin_time(s, samples[k]) / kBlock));
      VectorXd& sum =
          blocks.emplace(std::make_pair(s, block), VectorXd::Zero(size))
              .first->second;
      sum += residual[k] * columns.row(k).transpose();
    }
  }
  MatrixXd V = MatrixXd::Zero(size, size);
  for (const auto& [block, sum] : blocks) V += sum * sum.transpose();
  return std::max(1., G.ldlt().solve(V).trace() / size);
}

}  // namespace armcal
