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
    gain_.resize(factor.num_joints());
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

  // After Choose(): where the best candidate's gain peaks, in grid steps from
  // it, by a parabola through its neighbours.
  double Peak(int joint) const {
    const std::vector<double>& g = gain_[joint];
    const int k = choice_[joint];
    if (k == 0 || k + 1 >= static_cast<int>(g.size())) return 0;
    const double curvature = g[k - 1] - 2 * g[k] + g[k + 1];
    if (!(curvature < 0)) return 0;
    return std::clamp(0.5 * (g[k - 1] - g[k + 1]) / curvature, -0.5, 0.5);
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
    gain_[joint].assign(candidates_[joint].size(), 0);
    for (size_t k = 0; k < candidates_[joint].size(); ++k) {
      const VectorXd column = weighted_.col(candidates_[joint][k]);
      const VectorXd c = (qr.householderQ().transpose() * column)
                             .bottomRows(weighted_.rows() - qr.rank());
      if (c.norm() < 1e-8 * column.norm()) continue;
      gain_[joint][k] = std::pow(c.dot(y) / c.norm(), 2);
      if (gain_[joint][k] <= best) continue;
      best = gain_[joint][k];
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
  std::vector<std::vector<double>> gain_;  // of every candidate, per joint
};

struct LogGrid {
  double low, high;
  int count;

  double ratio() const { return std::pow(high / low, 1 / (count - 1.0)); }
  void AddTo(Law law, std::vector<CoulombTransition>* transitions) const {
    for (int k = 0; k < count; ++k) {
      transitions->push_back(
          {law, low * std::pow(high / low, k / (count - 1.0))});
    }
  }
};

constexpr LogGrid kVelocities = {1e-3, 0.3, 18};
constexpr LogGrid kDisplacements = {1e-4, 2e-2, 15};

}  // namespace

std::vector<CoulombTransition> CandidateTransitions() {
  std::vector<CoulombTransition> grid;
  kVelocities.AddTo(Law::kVelocity, &grid);
  kDisplacements.AddTo(Law::kDisplacement, &grid);
  return grid;
}

std::vector<CoulombTransition> FinerTransitions(
    const CoulombTransition& coarse) {
  const LogGrid& grid =
      coarse.law == Law::kVelocity ? kVelocities : kDisplacements;
  const LogGrid finer = {std::max(grid.low, coarse.width / grid.ratio()),
                         std::min(grid.high, coarse.width * grid.ratio()), 9};
  std::vector<CoulombTransition> transitions;
  finer.AddTo(coarse.law, &transitions);
  return transitions;
}

std::vector<int> ChooseTransitions(const BlockTriangularFactor& factor,
                                   const ModelParameters& parameters,
                                   const VectorXd& noise) {
  return Chooser(factor, parameters, noise).Choose();
}

std::vector<CoulombTransition> RefineTransitions(
    const BlockTriangularFactor& factor, const ModelParameters& parameters,
    const VectorXd& noise) {
  Chooser chooser(factor, parameters, noise);
  const std::vector<int> choice = chooser.Choose();
  std::vector<std::vector<CoulombTransition>> candidates(choice.size());
  for (const ModelParameter& p : parameters.parameters()) {
    if (p.is_joint_term && p.term == JointTerm::kCoulomb) {
      candidates[p.block].push_back(p.transition);
    }
  }
  std::vector<CoulombTransition> refined;
  for (size_t j = 0; j < choice.size(); ++j) {
    CoulombTransition t = candidates[j][choice[j]];
    const double ratio = candidates[j][1].width / candidates[j][0].width;
    t.width *= std::pow(ratio, chooser.Peak(static_cast<int>(j)));
    refined.push_back(t);
  }
  return refined;
}

}  // namespace armcal
