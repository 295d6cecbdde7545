#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace armcal {

// Cholesky factor of a symmetric positive definite matrix that is an arrow: its
// indices fall into arms that have no entries between each other, and what is
// common to them,
//   A = [ D_1        E_1 ]      D_k = L_k L_k',  H_k = L_k^-1 E_k,
//       [      ...   ... ]      S = C - sum_k H_k' H_k = L_S L_S'
//       [ E_1' ...   C   ]
// (the Schur complement of the arms). With arms of p and c in common this costs
// sum_k p (p + c)^2 + c^3 instead of (sum_k p + c)^3. Used as an ordinary
// factor, in the matrix' own indices, or arm by arm.
class ArrowFactor {
 public:
  ArrowFactor() = default;
  // `arms`: disjoint indices; what is in none is common. Entries between two
  // arms are not looked at.
  ArrowFactor(const Eigen::MatrixXd& A, std::vector<std::vector<int>> arms);

  const std::vector<int>& common() const { return common_; }
  const std::vector<int>& arm(int k) const { return arms_[k].indices; }

  Eigen::MatrixXd Solve(const Eigen::MatrixXd& b) const;  // A^-1 b
  double LogDeterminant() const;
  // A^-1 between the indices of arm k and the common ones, in that order.
  Eigen::MatrixXd InverseBeside(int k) const;

  // With these b' A^-1 c = sum_k HalfOfArm(b_k)' HalfOfArm(c_k) +
  // HalfOfCommon(b_S)' HalfOfCommon(c_S), b_S = b_common - sum_k H_k' b_k.
  Eigen::MatrixXd HalfOfArm(int k, const Eigen::MatrixXd& b) const;  // L_k^-1 b
  Eigen::MatrixXd HalfOfCommon(const Eigen::MatrixXd& b) const;      // L_S^-1 b
  const Eigen::MatrixXd& coupling(int k) const { return arms_[k].coupling; }

 private:
  struct Arm {
    std::vector<int> indices;
    Eigen::LLT<Eigen::MatrixXd> factor;
    Eigen::MatrixXd coupling;  // H_k
  };

  std::vector<Arm> arms_;
  std::vector<int> common_;
  Eigen::LLT<Eigen::MatrixXd> schur_;
  int size_ = 0;
};

}  // namespace armcal
