#include "calib/diagnose/select/inflation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::pair<int, long> BlockOf(const GapRows::Place& place) {
  return {place.segment,
          static_cast<long>(std::floor(place.time / Limits().block))};
}

double Inflation(const GapScreen& screen, const GapRows& rows,
                 const GapCandidate& candidate, const GapScreen::Fit& fit) {
  const int size = static_cast<int>(candidate.columns.size());
  MatrixXd G(size, size);
  int there = 0;
  for (int a = 0; a < size; ++a) {
    for (int b = 0; b < size; ++b) {
      G(a, b) = screen.G()(candidate.columns[a], candidate.columns[b]);
    }
    G(a, a) += screen.ridge(candidate.columns[a]);
    there += screen.raw(candidate.columns[a]) > 0;
  }
  std::map<std::pair<int, long>, VectorXd> blocks;
  for (int j = 0; j < rows.num_joints(); ++j) {
    const std::vector<GapRows::Place> places = rows.PlacesOfRows(j);
    const VectorXd residual = screen.Residual(j, fit);
    MatrixXd columns(residual.size(), size);
    for (int a = 0; a < size; ++a) {
      columns.col(a) = screen.Projected(candidate.columns[a], j);
    }
    for (size_t k = 0; k < places.size(); ++k) {
      VectorXd& sum = blocks.emplace(BlockOf(places[k]), VectorXd::Zero(size))
                          .first->second;
      sum += residual[k] * columns.row(k).transpose();
    }
  }
  MatrixXd V = MatrixXd::Zero(size, size);
  for (const auto& [block, sum] : blocks) V += sum * sum.transpose();
  return std::max(1., G.ldlt().solve(V).trace() / std::max(1, there));
}

}  // namespace armcal
