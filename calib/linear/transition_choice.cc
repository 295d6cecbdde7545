#include "calib/linear/transition_choice.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "calib/numerics/lowest_between.h"
#include "model/simd/kernels.h"

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
    const MatrixXd& R = factor.Triangle(i);
    const Eigen::Index k = R.rows();
    for (Eigen::Index c = 0; c < k; ++c) {
      const Eigen::Index to = c + 1 < k ? factor.columns(i)[c] : m;
      stack.A.col(to).segment(stack.begin[i], k) = R.col(c);
    }
  }
  return stack;
}

// Searches the widths as a separable least-squares problem: for given widths
// all else is linear and is solved exactly (Golub & Pereyra 1973, SIAM J.
// Numer. Anal. 10, variable projection), so that the search is over widths
// alone. All of it works on the triangular factor and reads no log again.
class Chooser {
 public:
  Chooser(const BlockTriangularFactor& factor,
          const ModelParameters& parameters, const VectorXd& noise)
      : factor_(factor), stack_(StackFactors(factor)), noise_(noise) {
    candidates_.resize(factor.num_joints());
    std::vector<int> always;
    for (int c = 0; c < parameters.size(); ++c) {
      const ModelParameter& p = parameters.parameters()[c];
      const bool coulomb = p.is_joint_term && p.term == JointTerm::kCoulomb;
      (coulomb ? candidates_[p.block] : always).push_back(c);
    }
    choice_.assign(factor.num_joints(), 0);
    gain_.resize(factor.num_joints());
    OrderColumns(always);
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
    return std::clamp(LowestBetween(-g[k - 1], -g[k], -g[k + 1]), -0.5, 0.5);
  }

 private:
  MatrixXd Weighted(const std::vector<int>& columns) const {
    MatrixXd A = stack_.A(Eigen::all, columns);
    for (int i = 0; i < factor_.num_joints(); ++i) {
      A.middleRows(stack_.begin[i], stack_.begin[i + 1] - stack_.begin[i]) *=
          noise_[i] > 0 ? 1 / noise_[i] : 0;
    }
    return A;
  }
  // Orders the columns: first those that are always there and independent
  // (pivoted QR), then all candidates, then the torque. One QR in this order
  // leaves below the first always_ rows what the former cannot explain of the
  // rest.
  void OrderColumns(const std::vector<int>& always) {
    if (!always.empty()) {
      const Eigen::ColPivHouseholderQR<MatrixXd> qr(Weighted(always));
      for (Eigen::Index k = 0; k < qr.rank(); ++k) {
        order_.push_back(always[qr.colsPermutation().indices()[k]]);
      }
    }
    always_ = static_cast<int>(order_.size());
    for (std::vector<int>& of_joint : candidates_) {
      for (int& c : of_joint) {
        order_.push_back(c);
        c = static_cast<int>(order_.size()) - 1;
      }
    }
    order_.push_back(factor_.num_parameters());
  }
  void Weigh() {
    weighted_ = Weighted(order_);
    const Eigen::Index columns = weighted_.cols();
    MatrixXd rows = MatrixXd::Zero((weighted_.rows() + 7) / 8 * 8, columns);
    rows.topRows(weighted_.rows()) = weighted_;
    R_ = MatrixXd::Zero(columns, columns);
    simd::BestKernels().householder(R_.data(), columns,
                                    static_cast<int>(columns), rows.data(),
                                    rows.rows(), rows.rows(), false);
  }
  // What the columns that are always there leave of these.
  MatrixXd Left(const std::vector<int>& columns) const {
    return R_(Eigen::seqN(always_, R_.rows() - always_), columns);
  }
  bool IsLeft(int column) const {
    return R_.col(column).tail(R_.rows() - always_).norm() >=
           1e-8 * R_.col(column).norm();
  }
  // The places of the chosen candidates of all joints but `skip`.
  std::vector<int> Chosen(int skip) const {
    std::vector<int> columns;
    for (int j = 0; j < factor_.num_joints(); ++j) {
      if (j == skip || candidates_[j].empty()) continue;
      const int chosen = candidates_[j][choice_[j]];
      if (IsLeft(chosen)) columns.push_back(chosen);
    }
    return columns;
  }
  // The gain of a candidate c is the fall (c'y)^2 / |c|^2 of the sum of
  // squares, c and y being what all other columns leave of them: adding one
  // column to a regression is a regression of what is left on what is left
  // (Frisch & Waugh 1933, Econometrica 1). It costs one product per candidate.
  void ChooseFor(int joint) {
    if (candidates_[joint].size() < 2 || noise_[joint] <= 0) return;
    std::vector<int> columns = candidates_[joint];
    columns.push_back(static_cast<int>(order_.size()) - 1);
    // Rows of Q'[candidates, y] below the rank are what the rest leaves over.
    MatrixXd left = Left(columns);
    const std::vector<int> others = Chosen(joint);
    if (!others.empty()) {
      const Eigen::ColPivHouseholderQR<MatrixXd> qr(Left(others));
      left.applyOnTheLeft(qr.householderQ().transpose());
      left.topRows(qr.rank()).setZero();
    }
    const auto y = left.rightCols<1>();
    double best = -1;
    gain_[joint].assign(candidates_[joint].size(), 0);
    for (size_t k = 0; k < candidates_[joint].size(); ++k) {
      const auto c = left.col(static_cast<Eigen::Index>(k));
      if (c.norm() < 1e-8 * R_.col(columns[k]).norm()) continue;
      gain_[joint][k] = std::pow(c.dot(y.col(0)) / c.norm(), 2);
      if (gain_[joint][k] <= best) continue;
      best = gain_[joint][k];
      choice_[joint] = static_cast<int>(k);
    }
  }
  // Back substitution for the chosen columns, then the rms of each joint's
  // residuals in units of the noise so far: the choice depends on the weights,
  // and these on the choice.
  void ReestimateNoise() {
    const std::vector<int> chosen = Chosen(-1);
    const Eigen::Index last = R_.cols() - 1;
    VectorXd r = weighted_.col(last), top = R_.col(last).head(always_);
    if (!chosen.empty()) {
      const VectorXd x = Left(chosen).colPivHouseholderQr().solve(
          R_.col(last).tail(R_.rows() - always_));
      r -= weighted_(Eigen::all, chosen) * x;
      top -= R_(Eigen::seqN(0, always_), chosen) * x;
    }
    R_.topLeftCorner(always_, always_)
        .triangularView<Eigen::Upper>()
        .solveInPlace(top);
    r -= weighted_.leftCols(always_) * top;
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
  // Columns of the stack in the order in which they are factored: first
  // always_ of them; candidates_ has the places of each joint's.
  std::vector<int> order_;
  int always_ = 0;
  std::vector<std::vector<int>> candidates_;
  MatrixXd weighted_, R_;  // the columns, and their triangular factor
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

constexpr LogGrid kVelocities = {CoulombTransition::kSharpestVelocity,
                                 CoulombTransition::kWidestVelocity, 18};
constexpr LogGrid kDisplacements = {CoulombTransition::kSharpestDisplacement,
                                    2e-2, 15};

const LogGrid& GridOf(Law law) {
  return law == Law::kVelocity ? kVelocities : kDisplacements;
}

}  // namespace

double LargestTransition(Law law) { return (1 - 1e-9) * GridOf(law).high; }

std::vector<CoulombTransition> CandidateTransitions() {
  std::vector<CoulombTransition> grid;
  kVelocities.AddTo(Law::kVelocity, &grid);
  kDisplacements.AddTo(Law::kDisplacement, &grid);
  return grid;
}

std::vector<CoulombTransition> FinerTransitions(
    const CoulombTransition& coarse) {
  const LogGrid& grid = GridOf(coarse.law);
  LogGrid finer = {coarse.width / grid.ratio(),
                   std::min(grid.high, coarse.width * grid.ratio()), 9};
  // What changes sign as sharply as the grid can say may do so at once, as
  // friction does in simulators.
  if (finer.low < .99 * grid.low) {
    const double high = std::max(finer.high, grid.low * grid.ratio());
    finer = {1e-4 * grid.low, high, 25};
  }
  std::vector<CoulombTransition> transitions;
  finer.AddTo(coarse.law, &transitions);
  return transitions;
}

std::vector<int> ChooseTransitions(const BlockTriangularFactor& factor,
                                   const ModelParameters& parameters,
                                   const VectorXd& noise) {
  return Chooser(factor, parameters, noise).Choose();
}

// Grids are geometric: a peak between two widths is their ratio to its power.
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
