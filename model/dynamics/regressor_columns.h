#pragma once

#include <vector>

#include "model/dynamics/joint_term.h"
#include "model/dynamics/momentum_regressor.h"

namespace armcal {

// Which functions the columns of a regressor are: column moment_index[k] is
// moments[k], column term_index[k] is terms[k].
struct RegressorColumns {
  std::vector<MomentColumn> moments;
  std::vector<int> moment_index;
  std::vector<JointTermColumn> terms;
  std::vector<int> term_index;

  int size() const { return static_cast<int>(moments.size() + terms.size()); }
};

}  // namespace armcal
