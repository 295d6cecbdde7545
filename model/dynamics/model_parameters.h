#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/dynamics/geometry_knowledge.h"
#include "model/dynamics/joint_term.h"
#include "model/dynamics/proximal_chain.h"
#include "model/dynamics/regressor.h"
#include "model/robot/robot.h"

namespace armcal {

// One entry of the parameter vector X.
struct ModelParameter {
  std::string name;  // "a2*hx[3]", "Izz[2] + armature[2]", "viscous[1]"
  std::string unit;
  int block = 0;               // 0-based joint whose block it belongs to
  bool is_joint_term = false;  // then `term` says which
  JointTerm term = JointTerm::kViscous;
  CoulombTransition transition;  // of kCoulomb
};

// The paper's model parameters X: the Lagrangian of the arm is F(q, qd) X, its
// equations tau = U(q, qd, qdd) X with a block-upper-triangular U (2.22).
// Joint terms follow the rigid parameters of their joint's block; they act on
// their own joint's row only. Columns that depend on others are regrouped, the
// decision taken by QR on random states.
class ModelParameters {
 public:
  struct Options {
    GeometryKnowledge geometry = GeometryKnowledge::kKnown;
    std::vector<JointTerm> joint_terms;
    // Per joint, how Coulomb friction passes through zero velocity; several
    // make a column each, to choose from.
    std::vector<std::vector<CoulombTransition>> transitions;
  };
  ModelParameters(const Robot& robot, const Options& options);

  int size() const { return static_cast<int>(parameters_.size()); }
  int num_joints() const { return static_cast<int>(chain_.joints.size()); }
  bool rotational(int i) const { return IsRotational(chain_.joints[i].type); }
  const std::vector<ModelParameter>& parameters() const { return parameters_; }
  // Block i is [block_begin(i), block_begin(i + 1)).
  int block_begin(int i) const { return block_begin_[i]; }
  int block_size(int i) const { return block_begin_[i + 1] - block_begin_[i]; }
  // The parameters that can be nonzero in joint i's row, ascending.
  const std::vector<int>& row_columns(int i) const { return row_columns_[i]; }
  // Sentences about joint terms that are part of other parameters.
  const std::vector<std::string>& merged() const { return merged_; }

  // Evaluates the columns of U, (2.19), or P and D; in the parameters' order.
  Regressor MakeRegressor() const;
  // X(V, W): the parameters' values for the inertia, lengths and joint terms of
  // `robot`, an arm of the same structure.
  Eigen::VectorXd Values(const Robot& robot) const;
  // Those of the robot that this was made from.
  const Eigen::VectorXd& nominal() const { return nominal_; }

  const ProximalChain& chain() const { return chain_; }
  // The unknown lengths, and what X is made of before regrouping:
  // X = regrouping() * X_full; the first moment_columns().size() entries of
  // X_full are moments times lengths, the others joint terms.
  const std::vector<Length>& unknown_lengths() const { return unknown_; }
  const std::vector<MomentColumn>& moment_columns() const { return moments_; }
  const Eigen::MatrixXd& regrouping() const { return regrouping_; }

 private:
  void ChooseUnknownLengths(const Robot& robot, GeometryKnowledge geometry);
  void ListColumns(const Robot& robot, const Options& options);
  void DropZeroMoments(const Robot& robot);
  void ChooseBasis();
  void NameMerged(int j);
  void NameParameters();
  std::string FullName(int full_column) const;
  std::string FullUnit(int full_column) const;
  int NumFull() const { return moments_.size() + terms_.size(); }
  int BlockOfFull(int c) const;
  Eigen::MatrixXd SampleRegressor() const;
  void KeepMoments(const Eigen::MatrixXd& U);
  void KeepTerms(const Eigen::MatrixXd& U);
  Eigen::VectorXd FullValues(const Robot& robot) const;

  ProximalChain chain_;
  std::vector<Length> unknown_;
  std::vector<MomentColumn> moments_;
  std::vector<JointTermColumn> terms_;
  std::vector<int> kept_;  // full columns that became parameters, in order
  Eigen::MatrixXd regrouping_;
  std::vector<ModelParameter> parameters_;
  std::vector<int> block_begin_;
  std::vector<std::vector<int>> row_columns_;
  std::vector<std::string> merged_;
  Eigen::VectorXd nominal_;
};

}  // namespace armcal
