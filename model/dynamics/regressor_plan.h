#pragma once

#include <vector>

#include "model/dynamics/proximal_chain.h"
#include "model/dynamics/regressor_columns.h"
#include "model/robot/link_paths.h"
#include "model/robot/robot.h"
#include "model/simd/regressor/chain_constants.h"

namespace armcal {

// What the kernels of model/simd have to know of an arm and of the columns
// wanted, prepared once: of each of its paths (model/robot/link_paths.h), as
// they know chains only.
class RegressorPlan {
 public:
  // Where a column goes in each row: to its rank among the columns that can be
  // nonzero there, or to its number; kNone: only the chains are wanted.
  enum class Places { kRanks, kNumbers, kNone };

  // Columns of model parameters, in the frames J of the chain.
  RegressorPlan(const ProximalChain& chain, const std::vector<Length>& unknown,
                const RegressorColumns& columns, Places places);
  // The ten inertial parameters of each link, in the links' frames. Ranks are
  // those among the columns of links i to n, of which some stay 0 where a robot
  // branches.
  RegressorPlan(const Robot& robot, Places places);
  // Of them `columns`, ascending; places are ranks.
  RegressorPlan(const Robot& robot, const std::vector<int>& columns);
  RegressorPlan(const RegressorPlan&) = delete;

  // A path's links as a chain. Columns are those of its own links, in places of
  // the whole robot's rows.
  struct Path {
    LinkPath links;
    simd::ChainConstants chain{};
  };
  const std::vector<Path>& paths() const { return paths_; }
  // Evaluate(chain, motion, rows, more_rows) of each path: with the motion and
  // the rows of its joints, from those of all.
  template <class Evaluate>
  void ForEachPath(const simd::ChainMotion& motion, double* const* rows,
                   double* const* more_rows, const Evaluate& evaluate) const;

  int num_joints() const { return static_cast<int>(row_sizes_.size()); }
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
  // What a path's constants point to.
  struct PathData {
    std::vector<simd::LinkConstants> links;
    std::vector<simd::LengthConstants> lengths;
    std::vector<std::vector<simd::LengthColumn>> length_columns;  // per link
    std::vector<std::vector<int>> places;                         // per link
    std::vector<int> row_sizes;
  };
  void AddPaths(const LinkParents& parents, int n);
  void AddLinks(const Robot& robot);
  void AddLengths(const std::vector<Length>& unknown, int path);
  std::vector<int> AddLink(const RegressorColumns& columns, int path, int i);
  void AddColumns(const RegressorColumns& columns, Places places);
  // Places of the links' ten: of column c of link i in row k.
  template <class Place>
  void AddInertials(const Place& place);
  void Connect(int path, const Eigen::Vector3d& gravity);

  LinkParents parents_;
  std::vector<Path> paths_;
  std::vector<PathData> data_;
  std::vector<int> row_sizes_;
  std::vector<std::vector<int>>
      length_of_;  // per path: of each unknown, its own
  std::vector<Term> terms_;
};

template <class Evaluate>
void RegressorPlan::ForEachPath(const simd::ChainMotion& motion,
                                double* const* rows, double* const* more_rows,
                                const Evaluate& evaluate) const {
  if (paths_.size() == 1) {
    evaluate(paths_[0].chain, motion, rows, more_rows);
    return;
  }
  for (const Path& path : paths_) {
    const auto of_path = [&path](auto of_all) {
      std::vector<std::decay_t<decltype(of_all[0])>> some;
      for (const int i : path.links.links) {
        if (of_all != nullptr) some.push_back(of_all[i]);
      }
      return some;
    };
    const auto q = of_path(motion.q), qd = of_path(motion.qd),
               qdd = of_path(motion.qdd);
    const auto to = of_path(rows), more = of_path(more_rows);
    const simd::ChainMotion some = {q.data(), qd.data(),
                                    qdd.empty() ? nullptr : qdd.data()};
    evaluate(path.chain, some, to.data(), more.data());
  }
}

}  // namespace armcal
