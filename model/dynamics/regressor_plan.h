#pragma once

#include <vector>

#include "model/dynamics/proximal_chain.h"
#include "model/dynamics/regressor_columns.h"
#include "model/robot/robot.h"
#include "model/simd/regressor/chain_constants.h"

namespace armcal {

// What the kernels of model/simd have to know of an arm and of the columns
// wanted, prepared once.
class RegressorPlan {
 public:
  // Where a column goes in each row: to its rank among the columns that can be
  // nonzero there, or to its number; kNone: only the chain is wanted.
  enum class Places { kRanks, kNumbers, kNone };

  // Columns of model parameters, in the frames J of the chain.
  RegressorPlan(const ProximalChain& chain, const std::vector<Length>& unknown,
                const RegressorColumns& columns, Places places);
  // The ten inertial parameters of each link, in the links' frames.
  RegressorPlan(const Robot& robot, Places places);
  // Of them `columns`, ascending; places are ranks.
  RegressorPlan(const Robot& robot, const std::vector<int>& columns);
  RegressorPlan(const RegressorPlan&) = delete;

  const simd::ChainConstants& chain() const { return chain_; }
  int num_joints() const { return static_cast<int>(links_.size()); }
  int row_size(int i) const { return row_sizes_[i]; }

  // A joint's own term: which place in its row, and of the Coulomb columns
  // which.
  struct Term {
    JointTermColumn column;
    int place;
    int coulomb;
  };
  const std::vector<Term>& terms() const { return terms_; }

 private:
  void AddLinks(const Robot& robot);
  std::vector<int> AddLink(const RegressorColumns& columns, int i);
  void AddColumns(const RegressorColumns& columns, Places places);
  void Connect(const Eigen::Vector3d& gravity);

  std::vector<simd::LinkConstants> links_;
  std::vector<simd::LengthConstants> lengths_;
  std::vector<std::vector<simd::LengthColumn>> length_columns_;  // per link
  std::vector<std::vector<int>> places_;                         // per link
  std::vector<int> row_sizes_;
  std::vector<Term> terms_;
  simd::ChainConstants chain_{};
};

}  // namespace armcal
