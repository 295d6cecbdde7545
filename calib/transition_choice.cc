#include "calib/transition_choice.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Law = CoulombTransition::Law;

// The stacked equations of all joints; row weights apply joint by joint.
struct Stack {
  MatrixXd A;                       // parameters, the right side last
  std::vector<Eigen::Index> begin;  // of each joint's rows, and the end
};

Stack StackFactors(const BlockTriangularFactor& factor) {
  const int m = factor.num_parameters();
  Stack stack;
  stack.begin.push_back(0);
  for (int i = 0; i < factor.num_joints(); ++i) {
    stack.begin.push_back(stack.begin.back() + factor.columns(i).size() + 1);
  }
  stack.A = MatrixXd::Zero(stack.begin.back(), m + 1);
  for (int i = 0; i < factor.num_joints(); ++i) {
    const MatrixXd R = factor.Triangle(i);
    const Eigen::Index k = R.rows();
    for (Eigen::Index c = 0; c < k; ++c) {
      const Eigen::Index to = c + 1 < k ? factor.columns(i)[c] : m;
      stack.A.col(to).segment(stack.begin[i], k) = R.col(c);
    }
  }
  return stack;
}

class Chooser {
 public:
  Chooser(const BlockTriangularFactor& factor,
          const ModelParameters& parameters, const VectorXd& noise)
      : factor_(factor), stack_(StackFactors(factor)), noise_(noise) {
    candidates_.resize(factor.num_joints());
    for (int c = 0; c < parameters.size(); ++c) {
      const ModelParameter& p = parameters.parameters()[c];
      const bool coulomb = p.is_joint_term && p.term == JointTerm::kCoulomb;
      (coulomb ? candidates_[p.block] : always_).push_back(c);
    }
    choice_.assign(factor.num_joints(), 0);
    Weigh();
  }

  std::vector<int> Choose() {
    for (int estimate = 0; estimate < 3; ++estimate) {
      for (int sweep = 0; sweep < 2; ++sweep) {
        for (int j = 0; j < factor_.num_joints(); ++j) ChooseFor(j);
      }
      ReestimateNoise();
    }
    return choice_;
  }

 private:
  void Weigh() {
    weighted_ = stack_.A;
    for (int i = 0; i < factor_.num_joints(); ++i) {
      weighted_.middleRows(stack_.begin[i],
                           stack_.begin[i + 1] - stack_.begin[i]) *=
          noise_[i] > 0 ? 1 / noise_[i] : 0;
    }
  }
  // The chosen columns, without joint `skip`'s Coulomb friction.
  MatrixXd Chosen(int skip) const {
    std::vector<int> columns = always_;
    for (int j = 0; j < factor_.num_joints(); ++j) {
      if (j != skip && !candidates_[j].empty()) {
        columns.push_back(candidates_[j][choice_[j]]);
      }
    }
    MatrixXd B(weighted_.rows(), columns.size());
    for (size_t k = 0; k < columns.size(); ++k) {
      B.col(k) = weighted_.col(columns[k]);
    }
    return B;
  }
  void ChooseFor(int joint) {
    if (candidates_[joint].size() < 2 || noise_[joint] <= 0) return;
    // Rows of Q'[candidates, y] below the rank are what the rest leaves over.
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(Chosen(joint));
    const VectorXd y =
        (qr.householderQ().transpose() * weighted_.rightCols<1>())
            .bottomRows(weighted_.rows() - qr.rank());
    double best = -1;
    for (size_t k = 0; k < candidates_[joint].size(); ++k) {
      const VectorXd column = weighted_.col(candidates_[joint][k]);
      const VectorXd c = (qr.householderQ().transpose() * column)
                             .bottomRows(weighted_.rows() - qr.rank());
      if (c.norm() < 1e-8 * column.norm()) continue;
      const double gain = std::pow(c.dot(y) / c.norm(), 2);
      if (gain <= best) continue;
      best = gain;
      choice_[joint] = static_cast<int>(k);
    }
  }
  void ReestimateNoise() {
    const MatrixXd B = Chosen(-1);
    const VectorXd x = B.colPivHouseholderQr().solve(weighted_.rightCols<1>());
    const VectorXd r = B * x - weighted_.rightCols<1>();
    for (int i = 0; i < factor_.num_joints(); ++i) {
      const Eigen::Index rows = stack_.begin[i + 1] - stack_.begin[i];
      const double count = static_cast<double>(std::max(1L, factor_.rows(i)));
      const double relative =
          r.segment(stack_.begin[i], rows).norm() / std::sqrt(count);
      if (noise_[i] > 0) noise_[i] *= std::max(relative, 1e-9);
    }
    Weigh();
  }

  const BlockTriangularFactor& factor_;
  Stack stack_;
  VectorXd noise_;
  MatrixXd weighted_;
  std::vector<int> always_;
  std::vector<std::vector<int>> candidates_;
  std::vector<int> choice_;
};

void AddLogGrid(Law law, double low, double high, int count,
                std::vector<CoulombTransition>* grid) {
  for (int k = 0; k < count; ++k) {
    const double width = low * std::pow(high / low, k / (count - 1.0));
    grid->push_back({law, width});
  }
}

}  // namespace

std::vector<CoulombTransition> CandidateTransitions() {
  std::vector<CoulombTransition> grid;
  AddLogGrid(Law::kVelocity, 1e-3, 0.3, 18, &grid);
  AddLogGrid(Law::kDisplacement, 1e-4, 2e-2, 15, &grid);
  return grid;
}

std::vector<int> ChooseTransitions(const BlockTriangularFactor& factor,
                                   const ModelParameters& parameters,
                                   const VectorXd& noise) {
  return Chooser(factor, parameters, noise).Choose();
}

}  // namespace armcal
