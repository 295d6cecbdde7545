#include "calib/diagnose/data/screen.h"

#include <glog/logging.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/diagnose/data/inner_products.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Inner products of a joint's new columns with each other, with its baseline
// and with the target. Rows are gone through once, here; whatever is asked
// afterwards is products of these matrices.
void GapScreen::Products::Add(const std::vector<Column>& all, int first,
                              int joint, const BaselineFit::Rows& rows) {
  const Eigen::Index before = static_cast<Eigen::Index>(columns.size());
  for (int c = first; c < static_cast<int>(all.size()); ++c) {
    if ((*all[c])[joint].size() > 0) columns.push_back(c);
  }
  const Eigen::Index count = static_cast<Eigen::Index>(columns.size());
  const Eigen::Index more = count - before;
  if (more == 0) return;
  MatrixXd C(rows.target.size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    C.col(k) = (*all[columns[k]])[joint];
  }
  of_columns.conservativeResize(count, count);
  of_columns.rightCols(more) = InnerProductsWithLast(C, more);
  of_columns.bottomLeftCorner(more, before) =
      of_columns.topRightCorner(before, more).transpose();
  by_baseline.conservativeResize(rows.of_columns.rows(), count);
  by_baseline.rightCols(more) =
      InnerProducts(rows.columns.values, C.rightCols(more));
  by_target.conservativeResize(count);
  by_target.tail(more) = C.rightCols(more).transpose() * rows.target;
}

GapScreen::Products GapScreen::Products::Only(
    const std::vector<int>& which) const {
  Products only;
  std::vector<Eigen::Index> at;
  for (size_t k = 0; k < which.size(); ++k) {
    const auto own = std::lower_bound(columns.begin(), columns.end(), which[k]);
    if (own == columns.end() || *own != which[k]) continue;
    only.columns.push_back(static_cast<int>(k));
    at.push_back(own - columns.begin());
  }
  only.of_columns = of_columns(at, at);
  only.by_baseline = by_baseline(Eigen::all, at);
  only.by_target = by_target(at);
  return only;
}

GapScreen::GapScreen(std::vector<BaselineColumns> baseline, int size,
                     JointRows target, ColumnPrior prior)
    : baseline_(std::move(baseline), size, std::move(target),
                std::move(prior)) {
  products_.resize(num_joints());
  for (int j = 0; j < num_joints(); ++j) {
    products_[j].by_baseline.resize(baseline_.rows(j).of_target.size(), 0);
  }
}

void GapScreen::AddKnown(const std::vector<BaselineColumns>& baseline,
                         const JointRows& target) {
  CHECK_LT(factored_, 0);
  baseline_.AddKnown(baseline, target);
}

int GapScreen::AddColumn(JointRows column) {
  CHECK_EQ(column.size(), products_.size());
  for (int j = 0; j < num_joints(); ++j) column[j] /= baseline_.weight(j);
  columns_.push_back(std::make_shared<const JointRows>(std::move(column)));
  return size() - 1;
}

void GapScreen::Weigh(const VectorXd& factor) {
  baseline_.Weigh(factor);
  if (factored_ >= 0) Project(0);
}

void GapScreen::ScaleBaseline(const std::vector<int>& which, double factor) {
  baseline_.Scale(which, factor);
  if (factored_ >= 0) Project(0);
}

GapScreen GapScreen::Only(const std::vector<int>& columns) const {
  GapScreen only(baseline_);
  for (const int c : columns) only.columns_.push_back(columns_[c]);
  for (const Products& own : products_) {
    only.products_.push_back(own.Only(columns));
  }
  only.Project(0);
  return only;
}

void GapScreen::Factor() {
  const int before = std::max(0, factored_);
  tbb::parallel_for(0, num_joints(), [&](int j) {
    products_[j].Add(columns_, before, j, baseline_.rows(j));
  });
  Project(before);
}

// One joint's share of the Schur complements: its columns' products with the
// arm of the baseline are solved with the arm's factor; what is left of them
// for the shared columns, and the joint's own part of the projected Gram matrix
// and gradient, are returned. Arms are independent of each other, so that
// joints do it at the same time.
GapScreen::ArmShare GapScreen::ProjectOnArm(int joint, int before) {
  const Products& own = products_[joint];
  const BaselineFit::Places& places = baseline_.places(joint);
  const ArrowFactor& factor = baseline_.factor();
  const double weight = baseline_.weight(joint), squared = weight * weight;
  MatrixXd& half = arm_half_[joint];
  const Eigen::Index known = before == 0 ? 0 : half.cols();
  const Eigen::Index count = own.of_columns.cols(), more = count - known;
  const VectorXd scale = weight * baseline_.ScaleOf(joint);
  ArmShare share;
  share.cross = scale.asDiagonal() * own.by_baseline.rightCols(more);
  MatrixXd of_arm = MatrixXd::Zero(factor.arm(joint).size(), more);
  of_arm(places.in_arm, Eigen::all) = share.cross(places.own, Eigen::all);
  half.conservativeResize(of_arm.rows(), count);
  half.rightCols(more) = factor.HalfOfArm(joint, of_arm);
  const MatrixXd added = half.rightCols(more);
  share.common = -factor.coupling(joint).transpose() * added;
  share.common(places.in_common, Eigen::all) +=
      share.cross(places.shared, Eigen::all);
  share.raw = squared * own.of_columns.diagonal().tail(more);
  share.g = squared * own.by_target.tail(more) -
            added.transpose() * baseline_.arm_gradient(joint);
  share.gram = InnerProductsWithLast(half, more);
  share.gram = squared * own.of_columns.rightCols(more) - share.gram;
  return share;
}

// Sums the joints' shares into what is of all of them, some columns each to a
// thread, the joints in their order.
void GapScreen::AddShares(const std::vector<ArmShare>& shares, int before,
                          MatrixXd* G) {
  constexpr int kTogether = 64;
  tbb::parallel_for(
      tbb::blocked_range<int>(before, size(), kTogether),
      [&](const tbb::blocked_range<int>& some) {
        for (int j = 0; j < num_joints(); ++j) {
          const ArmShare& share = shares[j];
          const std::vector<int>& columns = products_[j].columns;
          const std::vector<int>& which = baseline_.rows(j).columns.which;
          const Eigen::Index known = share.gram.rows() - share.gram.cols();
          for (auto at = std::lower_bound(columns.begin() + known,
                                          columns.end(), some.begin());
               at != columns.end() && *at < some.end(); ++at) {
            const Eigen::Index k = at - columns.begin() - known;
            const int c = *at;
            G->col(c - before)(columns) += share.gram.col(k);
            cross_.col(c)(which) += share.cross.col(k);
            common_half_.col(c) += share.common.col(k);
            raw_[c] += share.raw[k];
            g_[c] += share.g[k];
          }
        }
      });
}

// Candidates projected on what the baseline cannot absorb (Frisch and Waugh
// 1933): with A the baseline's columns and C the candidates',
//   G = C' C - C' A (A' A)^-1 A' C,   g = C' r - C' A (A' A)^-1 A' r,
// where (A' A) holds the prior and other data. Whatever is asked of any set of
// candidates is then asked of G and g, whose size is the number of candidates,
// and the rows are not needed any more. Halves H = L^-1 A' C are kept, so that
// new columns cost products with these only.
void GapScreen::Project(int before) {
  if (before == 0) {
    baseline_.Factor();
    arm_half_.assign(num_joints(), {});
  }
  const int count = size(), more = count - before;
  const auto widen = [=](Eigen::Index rows, MatrixXd* x) {
    x->conservativeResize(rows, count);
    x->rightCols(more).setZero();
  };
  const ArrowFactor& factor = baseline_.factor();
  widen(baseline_.size(), &cross_);
  widen(static_cast<Eigen::Index>(factor.common().size()), &common_half_);
  for (VectorXd* x : {&raw_, &g_}) {
    x->conservativeResize(count);
    x->tail(more).setZero();
  }
  // All columns by the new ones.
  MatrixXd G = MatrixXd::Zero(count, more);
  std::vector<ArmShare> shares(num_joints());
  tbb::parallel_for(0, num_joints(),
                    [&](int j) { shares[j] = ProjectOnArm(j, before); });
  AddShares(shares, before, &G);
  const MatrixXd common = factor.HalfOfCommon(common_half_.rightCols(more));
  common_half_.rightCols(more) = common;
  G -= InnerProductsWithLast(common_half_, more);
  g_.tail(more) -= common.transpose() * baseline_.common_gradient();
  G_.conservativeResize(count, count);
  G_.rightCols(more) = G;
  G_.bottomLeftCorner(more, before) = G.topRows(before).transpose();
  factored_ = count;
}

VectorXd GapScreen::Gradient(const JointRows& target) const {
  std::vector<std::vector<int>> one;
  for (const VectorXd& rows : target) one.emplace_back(rows.size(), 0);
  return Gradients(target, one, 1);
}

// g of the screen for another target, and of parts of its rows, each in a
// column of its own: rows of a part are contiguous in time, so that the
// products with each part's rows are one product with a block of them. Blocks
// of a residual are made of these (null.cc) without the columns being
// multiplied again.
MatrixXd GapScreen::Gradients(const JointRows& target,
                              const std::vector<std::vector<int>>& part_of_row,
                              int parts) const {
  MatrixXd g = MatrixXd::Zero(size(), parts);
  MatrixXd gradient = MatrixXd::Zero(baseline_.size(), parts);
  for (int j = 0; j < num_joints(); ++j) {
    const std::vector<int>& part = part_of_row[j];
    const BaselineColumns& own = baseline_.rows(j).columns;
    const VectorXd scale = baseline_.ScaleOf(j);
    const int rows = static_cast<int>(part.size());
    for (int begin = 0, end = 0; begin < rows; begin = end) {
      while (end < rows && part[end] == part[begin]) ++end;
      const int p = part[begin], count = end - begin;
      const VectorXd here = target[j].segment(begin, count);
      const VectorXd products =
          own.values.middleRows(begin, count).transpose() * here;
      for (Eigen::Index k = 0; k < products.size(); ++k) {
        gradient(own.which[k], p) += scale[k] * products[k];
      }
      for (const int c : products_[j].columns) {
        g(c, p) += baseline_.weight(j) *
                   (*columns_[c])[j].segment(begin, count).dot(here);
      }
    }
  }
  return g - cross_.transpose() * baseline_.factor().Solve(gradient);
}

// The candidates' normal equations with the baseline free, whose Schur
// complement is G:
//   x = (G_SS + ridge)^-1 g_S,  cov = (G_SS + ridge)^-1,  delta_chi2 = g_S' x,
// by how much chi squared is lower with them than with the baseline alone.
GapScreen::Fit GapScreen::Solve(const std::vector<int>& columns) const {
  Fit fit;
  fit.columns = columns;
  const int size = static_cast<int>(columns.size());
  if (size == 0) return fit;
  MatrixXd G = G_(columns, columns);
  const VectorXd g = g_(columns);
  for (int k = 0; k < size; ++k) G(k, k) += ridge(columns[k]);
  const Eigen::LLT<MatrixXd> factor(G);
  fit.coefficients = factor.solve(g);
  fit.covariance = factor.solve(MatrixXd::Identity(size, size));
  fit.delta_chi2 = g.dot(fit.coefficients);
  return fit;
}

// Delta chi^2 of columns that are not among those of the screen: their Gram
// matrix and gradient are projected here, once, by the baseline's factor. A
// ridge of 1e-9 keeps columns that are the same from dividing by nothing.
double GapScreen::DeltaChi2Of(const std::vector<JointRows>& columns) const {
  const int size = static_cast<int>(columns.size());
  MatrixXd G = MatrixXd::Zero(size, size);
  MatrixXd cross = MatrixXd::Zero(baseline_.size(), size);
  VectorXd g = VectorXd::Zero(size);
  for (int a = 0; a < size; ++a) {
    for (int j = 0; j < num_joints(); ++j) {
      const VectorXd& column = columns[a][j];
      if (column.size() == 0) continue;
      baseline_.AddProducts(j, column, cross.col(a));
      g[a] += baseline_.weight(j) * column.dot(baseline_.rows(j).target);
      for (int b = 0; b < size; ++b) {
        if (columns[b][j].size() > 0) G(a, b) += column.dot(columns[b][j]);
      }
    }
  }
  G.diagonal() *= 1 + 1e-9;
  const MatrixXd absorbed = baseline_.factor().Solve(cross);
  G -= cross.transpose() * absorbed;
  g -= absorbed.transpose() * baseline_.gradient();
  return g.dot(G.ldlt().solve(g));
}

VectorXd GapScreen::Baseline(const Fit& fit) const {
  VectorXd gradient = baseline_.gradient();
  for (size_t k = 0; k < fit.columns.size(); ++k) {
    gradient -= fit.coefficients[k] * cross_.col(fit.columns[k]);
  }
  return baseline_.factor().Solve(gradient);
}

JointRows GapScreen::Residuals(const Fit& fit) const {
  const VectorXd x = Baseline(fit);
  JointRows residuals;
  for (int j = 0; j < num_joints(); ++j) {
    residuals.push_back(ResidualGiven(j, fit, x));
  }
  return residuals;
}

VectorXd GapScreen::ResidualGiven(int joint, const Fit& fit,
                                  const VectorXd& x) const {
  const double weight = baseline_.weight(joint);
  VectorXd residual =
      weight * baseline_.rows(joint).target - baseline_.Torque(joint, x);
  for (size_t k = 0; k < fit.columns.size(); ++k) {
    const VectorXd& column = (*columns_[fit.columns[k]])[joint];
    if (column.size() > 0) residual -= weight * fit.coefficients[k] * column;
  }
  return residual;
}

JointRows GapScreen::Projected(int column) const {
  const VectorXd absorbed = baseline_.factor().Solve(cross_.col(column));
  JointRows projected;
  for (int j = 0; j < num_joints(); ++j) {
    projected.push_back(-baseline_.Torque(j, absorbed));
    const VectorXd& own = (*columns_[column])[j];
    if (own.size() > 0) projected[j] += baseline_.weight(j) * own;
  }
  return projected;
}

double GapScreen::PriorCost(const Fit& fit) const {
  const VectorXd x = Baseline(fit);
  return baseline_.prior().Residual(x).squaredNorm() +
         baseline_.KnownResidual(x).squaredNorm();
}

// ln det of the information on baseline and columns together, by the
// determinant of a partitioned matrix: ln det A' A + ln det G_SS, the latter
// from the covariance's.
double GapScreen::LogDeterminant(const Fit& fit) const {
  const double sum = baseline_.factor().LogDeterminant();
  if (fit.columns.empty()) return sum;
  return sum - std::log(fit.covariance.determinant());
}

}  // namespace armcal
