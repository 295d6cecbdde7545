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

// Blocks of Limits().block seconds from each log's beginning: what is left of
// the torque is correlated within a block, and nearly independent from one to
// the next, as the blocks of Newey and West (1987) and Kuensch (1989) have to
// be.
std::pair<int, long> BlockOf(const GapRows::Place& place) {
  return {place.segment,
          static_cast<long>(std::floor(place.time / Limits().block))};
}

// The sandwich estimator of a least squares fit (White 1980; with blocks in
// place of single samples, Newey and West 1987) has the covariance
//   G^-1 V G^-1,  V = sum over blocks of s_b s_b',  s_b = sum of c_k r_k in b,
// c_k the candidate's projected columns and r_k the residual at row k. With
// white noise of unit variance V = G in the mean, and delta_chi2 = g' G^-1 g
// has the mean k; with V it is tr(G^-1 V). Their ratio is by how much
// delta_chi2 is too large on average. Of a likelihood ratio under a wrong model
// (Kent 1982) that is the first-order correction which Rao and Scott (1981)
// make to chi squared tests of survey data.
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
  const JointRows residuals = screen.Residuals(fit);
  std::vector<JointRows> projected;
  for (const int c : candidate.columns) {
    projected.push_back(screen.Projected(c));
  }
  for (int j = 0; j < rows.num_joints(); ++j) {
    const std::vector<GapRows::Place> places = rows.PlacesOfRows(j);
    const VectorXd& residual = residuals[j];
    MatrixXd columns(residual.size(), size);
    for (int a = 0; a < size; ++a) columns.col(a) = projected[a][j];
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
