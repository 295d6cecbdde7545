#include "calib/numerics/unseen_combinations.h"

#include <algorithm>
#include <cmath>

#include "calib/numerics/combination.h"
#include "calib/numerics/singular_values.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<std::string> UnseenCombinations(
    const std::vector<int>& free, const std::vector<std::string>& names,
    const MatrixXd& data, const VectorXd& prior) {
  constexpr double kNoPrior = 1e100;  // a variance
  VectorXd size(free.size());
  for (size_t f = 0; f < free.size(); ++f) {
    const int k = free[f];
    // Without a prior: a thousand times what it would be alone.
    size[f] = prior[k] < kNoPrior ? std::sqrt(prior[k])
                                  : 1e3 / std::max(data.col(k).norm(), 1e-150);
  }
  const MatrixXd relative = data(Eigen::all, free) * size.asDiagonal();
  const SingularValues svd = DecomposeSingular(relative);
  Eigen::Index rank = 0;
  while (rank < svd.s.size() && svd.s[rank] > 1) ++rank;
  std::vector<std::string> texts;
  for (const Combination& c : NameCombinations(
           svd.V.rightCols(size.size() - rank), size.cwiseInverse(), names)) {
    texts.push_back(c.text);
  }
  return texts;
}

}  // namespace armcal
