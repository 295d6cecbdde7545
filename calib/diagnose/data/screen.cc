#include "calib/diagnose/data/screen.h"

#include <glog/logging.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "model/signals/dense_solvers.h"
#include "model/simd/kernels.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// a' b, whole groups of rows in lanes.
MatrixXd InnerProducts(const MatrixXd& a, const MatrixXd& b) {
  const Eigen::Index whole = a.rows() / 8 * 8, rest = a.rows() - whole;
  MatrixXd products(a.cols(), b.cols());
  if (products.size() == 0) return products;
  simd::BestKernels().inner_products(
      a.data(), a.rows(), static_cast<int>(a.cols()), b.data(), b.rows(),
      static_cast<int>(b.cols()), whole, products.data());
  products += a.bottomRows(rest).transpose() * b.bottomRows(rest);
  return products;
}

}  // namespace

GapScreen::GapScreen(std::vector<BaselineColumns> baseline, int size,
                     JointRows target)
    : baseline_(std::move(baseline)), target_(std::move(target)) {
  CHECK_EQ(baseline_.size(), target_.size());
  known_information_ = MatrixXd::Zero(size, size);
  known_gradient_ = VectorXd::Zero(size);
  products_.resize(target_.size());
  tbb::parallel_for(size_t{0}, products_.size(), [&](size_t j) {
    CHECK_EQ(baseline_[j].values.rows(), target_[j].size());
    products_[j].of_baseline =
        InnerProducts(baseline_[j].values, baseline_[j].values);
    products_[j].of_target = baseline_[j].values.transpose() * target_[j];
  });
}

void GapScreen::AddInformation(const MatrixXd& AtA, const VectorXd& Aty) {
  CHECK_EQ(known_.size(), 0);
  CHECK_LT(factored_, 0);
  known_information_ = AtA;
  known_gradient_ = Aty;
  // The root of a matrix that may be singular, which a triangular one of it
  // would not survive: A'A = U'U with U = sqrt(values) vectors'.
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(AtA);
  const VectorXd& values = eigen.eigenvalues();
  const double least = 1e-14 * values.cwiseAbs().maxCoeff();
  const VectorXd root = values.unaryExpr(
      [least](double x) { return x > least ? std::sqrt(x) : 0; });
  known_root_ = root.asDiagonal() * eigen.eigenvectors().transpose();
  known_ = eigen.eigenvectors().transpose() * Aty;
  for (Eigen::Index k = 0; k < known_.size(); ++k) {
    known_[k] = root[k] > 0 ? known_[k] / root[k] : 0;
  }
}

int GapScreen::AddColumn(JointRows column) {
  CHECK_EQ(column.size(), target_.size());
  columns_.push_back(std::move(column));
  return size() - 1;
}

void GapScreen::Weigh(const VectorXd& factor) {
  CHECK_EQ(factor.size(), num_joints());
  for (int j = 0; j < num_joints(); ++j) {
    const double f = factor[j];
    baseline_[j].values *= f;
    target_[j] *= f;
    for (JointRows& column : columns_) column[j] *= f;
    Products& own = products_[j];
    for (MatrixXd* x : {&own.of_columns, &own.by_baseline, &own.of_baseline}) {
      *x *= f * f;
    }
    own.by_target *= f * f;
    own.of_target *= f * f;
  }
  if (factored_ >= 0) Project(0);
}

void GapScreen::ScaleBaseline(int first, double factor) {
  const Eigen::Index all = known_gradient_.size(), more = all - first;
  known_information_.rightCols(more) *= factor;
  known_information_.bottomRows(more) *= factor;
  known_gradient_.tail(more) *= factor;
  if (known_root_.size() > 0) known_root_.rightCols(more) *= factor;
  for (int j = 0; j < num_joints(); ++j) {
    BaselineColumns& own = baseline_[j];
    const auto begin =
        std::lower_bound(own.which.begin(), own.which.end(), first);
    const Eigen::Index tail = own.which.end() - begin;
    Products& products = products_[j];
    own.values.rightCols(tail) *= factor;
    products.of_baseline.rightCols(tail) *= factor;
    products.of_baseline.bottomRows(tail) *= factor;
    products.of_target.tail(tail) *= factor;
    if (products.by_baseline.size() > 0) {
      products.by_baseline.bottomRows(tail) *= factor;
    }
  }
  if (factored_ >= 0) Project(0);
}

GapScreen GapScreen::Only(const std::vector<int>& columns) const {
  GapScreen only = *this;
  only.columns_.clear();
  for (const int c : columns) only.columns_.push_back(columns_[c]);
  for (Products& own : only.products_) {
    own.columns.clear();
    own.of_columns.resize(0, 0);
    own.by_baseline.resize(own.of_baseline.rows(), 0);
    own.by_target.resize(0);
  }
  only.factored_ = -1;
  only.Factor();
  return only;
}

void GapScreen::AddProducts(int joint) {
  Products& own = products_[joint];
  const Eigen::Index before = static_cast<Eigen::Index>(own.columns.size());
  for (int c = std::max(0, factored_); c < size(); ++c) {
    if (columns_[c][joint].size() > 0) own.columns.push_back(c);
  }
  const Eigen::Index count = static_cast<Eigen::Index>(own.columns.size());
  const Eigen::Index more = count - before;
  if (more == 0) return;
  MatrixXd C(target_[joint].size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    C.col(k) = columns_[own.columns[k]][joint];
  }
  const MatrixXd added = C.rightCols(more);
  own.of_columns.conservativeResize(count, count);
  own.of_columns.rightCols(more) = InnerProducts(C, added);
  own.of_columns.bottomLeftCorner(more, before) =
      own.of_columns.topRightCorner(before, more).transpose();
  own.by_baseline.conservativeResize(own.of_baseline.rows(), count);
  own.by_baseline.rightCols(more) =
      InnerProducts(baseline_[joint].values, added);
  own.by_target.conservativeResize(count);
  own.by_target.tail(more) = added.transpose() * target_[joint];
}

void GapScreen::Factor() {
  tbb::parallel_for(0, num_joints(), [&](int j) { AddProducts(j); });
  Project(std::max(0, factored_));
}

void GapScreen::Project(int before) {
  if (before == 0) {
    information_ = known_information_;
    information_.diagonal().array() += 1;
    gradient_ = known_gradient_;
    for (int j = 0; j < num_joints(); ++j) {
      const std::vector<int>& which = baseline_[j].which;
      information_(which, which) += products_[j].of_baseline;
      gradient_(which) += products_[j].of_target;
    }
    factor_.compute(information_);
  }
  const int count = size(), more = count - before;
  cross_.conservativeResize(gradient_.size(), count);
  cross_.rightCols(more).setZero();
  // All columns by the new ones.
  MatrixXd G = MatrixXd::Zero(count, more);
  VectorXd g = VectorXd::Zero(more);
  for (int j = 0; j < num_joints(); ++j) {
    const Products& own = products_[j];
    for (size_t k = 0; k < own.columns.size(); ++k) {
      const int c = own.columns[k];
      if (c < before) continue;
      cross_(baseline_[j].which, c) += own.by_baseline.col(k);
      g[c - before] += own.by_target[k];
      for (size_t l = 0; l < own.columns.size(); ++l) {
        G(own.columns[l], c - before) += own.of_columns(l, k);
      }
    }
  }
  raw_.conservativeResize(count);
  raw_.tail(more) = G.bottomRows(more).diagonal();
  half_.conservativeResize(gradient_.size(), count);
  half_.rightCols(more) = factor_.matrixL().solve(cross_.rightCols(more));
  const MatrixXd added = half_.rightCols(more);
  G -= InnerProducts(half_, added);
  g -= added.transpose() * factor_.matrixL().solve(gradient_);
  G_.conservativeResize(count, count);
  G_.rightCols(more) = G;
  G_.bottomLeftCorner(more, before) = G.topRows(before).transpose();
  g_.conservativeResize(count);
  g_.tail(more) = g;
  factored_ = count;
}

VectorXd GapScreen::Gradient(const JointRows& target) const {
  std::vector<std::vector<int>> one;
  for (const VectorXd& rows : target) one.emplace_back(rows.size(), 0);
  return Gradients(target, one, 1);
}

MatrixXd GapScreen::Gradients(const JointRows& target,
                              const std::vector<std::vector<int>>& part_of_row,
                              int parts) const {
  MatrixXd g = MatrixXd::Zero(size(), parts);
  MatrixXd gradient = MatrixXd::Zero(gradient_.size(), parts);
  for (size_t j = 0; j < target.size(); ++j) {
    const std::vector<int>& part = part_of_row[j];
    const int rows = static_cast<int>(part.size());
    for (int begin = 0, end = 0; begin < rows; begin = end) {
      while (end < rows && part[end] == part[begin]) ++end;
      const int p = part[begin], count = end - begin;
      const auto here = target[j].segment(begin, count);
      const VectorXd own =
          baseline_[j].values.middleRows(begin, count).transpose() * here;
      for (Eigen::Index k = 0; k < own.size(); ++k) {
        gradient(baseline_[j].which[k], p) += own[k];
      }
      for (int c = 0; c < size(); ++c) {
        if (columns_[c][j].size() == 0) continue;
        g(c, p) += columns_[c][j].segment(begin, count).dot(here);
      }
    }
  }
  return g - cross_.transpose() * factor_.solve(gradient);
}

GapScreen::Fit GapScreen::Solve(const std::vector<int>& columns) const {
  Fit fit;
  fit.columns = columns;
  const int size = static_cast<int>(columns.size());
  MatrixXd G(size, size);
  VectorXd g(size);
  for (int k = 0; k < size; ++k) {
    g[k] = g_[columns[k]];
    for (int l = 0; l < size; ++l) G(k, l) = G_(columns[k], columns[l]);
  }
  if (size == 0) return fit;
  for (int k = 0; k < size; ++k) G(k, k) += ridge(columns[k]);
  const Eigen::LLT<MatrixXd> factor(G);
  fit.coefficients = factor.solve(g);
  fit.covariance = factor.solve(MatrixXd::Identity(size, size));
  fit.drop = g.dot(fit.coefficients);
  return fit;
}

double GapScreen::DropOf(const std::vector<JointRows>& columns) const {
  const int size = static_cast<int>(columns.size());
  MatrixXd G = MatrixXd::Zero(size, size);
  MatrixXd cross = MatrixXd::Zero(gradient_.size(), size);
  VectorXd g = VectorXd::Zero(size);
  for (int a = 0; a < size; ++a) {
    for (size_t j = 0; j < target_.size(); ++j) {
      const VectorXd& column = columns[a][j];
      if (column.size() == 0) continue;
      cross(baseline_[j].which, a) += baseline_[j].values.transpose() * column;
      g[a] += column.dot(target_[j]);
      for (int b = 0; b < size; ++b) {
        if (columns[b][j].size() > 0) G(a, b) += column.dot(columns[b][j]);
      }
    }
  }
  G.diagonal() *= 1 + 1e-9;
  const MatrixXd half = factor_.matrixL().solve(cross);
  G -= half.transpose() * half;
  g -= half.transpose() * factor_.matrixL().solve(gradient_);
  return g.dot(G.ldlt().solve(g));
}

VectorXd GapScreen::Baseline(const Fit& fit) const {
  VectorXd gradient = gradient_;
  for (size_t k = 0; k < fit.columns.size(); ++k) {
    gradient -= fit.coefficients[k] * cross_.col(fit.columns[k]);
  }
  return factor_.solve(gradient);
}

VectorXd GapScreen::Residual(int joint, const Fit& fit) const {
  VectorXd residual = target_[joint] - baseline_[joint].Times(Baseline(fit));
  for (size_t k = 0; k < fit.columns.size(); ++k) {
    const VectorXd& column = columns_[fit.columns[k]][joint];
    if (column.size() > 0) residual -= fit.coefficients[k] * column;
  }
  return residual;
}

VectorXd GapScreen::GradientBeside(const JointRows& torque) const {
  VectorXd gradient = gradient_;
  for (size_t j = 0; j < target_.size(); ++j) {
    if (torque[j].size() > 0) {
      gradient(baseline_[j].which) -=
          baseline_[j].values.transpose() * torque[j];
    }
  }
  return gradient;
}

VectorXd GapScreen::BaselineBeside(const JointRows& torque) const {
  return factor_.solve(GradientBeside(torque));
}

VectorXd GapScreen::BaselineBeside(const JointRows& torque, int columns) const {
  VectorXd x = VectorXd::Zero(gradient_.size());
  x.head(columns) = information_.topLeftCorner(columns, columns)
                        .llt()
                        .solve(GradientBeside(torque).head(columns));
  return x;
}

VectorXd GapScreen::ResidualBeside(const JointRows& torque) const {
  const VectorXd x = BaselineBeside(torque);
  Eigen::Index rows = x.size() + known_.size();
  for (const VectorXd& target : target_) rows += target.size();
  VectorXd residual(rows);
  Eigen::Index at = 0;
  for (size_t j = 0; j < target_.size(); ++j) {
    auto here = residual.segment(at, target_[j].size());
    here = target_[j] - baseline_[j].Times(x);
    if (torque[j].size() > 0) here -= torque[j];
    at += target_[j].size();
  }
  residual.segment(at, x.size()) = x;
  if (known_.size() > 0) {
    residual.tail(known_.size()) = known_root_ * x - known_;
  }
  return residual;
}

VectorXd GapScreen::Projected(int column, int joint) const {
  VectorXd projected =
      -baseline_[joint].Times(factor_.solve(VectorXd(cross_.col(column))));
  const VectorXd& own = columns_[column][joint];
  if (own.size() > 0) projected += own;
  return projected;
}

double GapScreen::PriorCost(const Fit& fit) const {
  const VectorXd x = Baseline(fit);
  double cost = x.squaredNorm();
  if (known_.size() > 0) cost += (known_root_ * x - known_).squaredNorm();
  return cost;
}

double GapScreen::LogDeterminant(const Fit& fit) const {
  double sum = 2 * factor_.matrixLLT().diagonal().array().log().sum();
  if (fit.columns.empty()) return sum;
  return sum - std::log(fit.covariance.determinant());
}

VectorXd GapScreen::FittedRows() const {
  const MatrixXd covariance = BaselineCovariance();
  VectorXd fitted(num_joints());
  for (int j = 0; j < num_joints(); ++j) {
    const std::vector<int>& which = baseline_[j].which;
    fitted[j] =
        products_[j].of_baseline.cwiseProduct(covariance(which, which)).sum();
  }
  return fitted;
}

MatrixXd GapScreen::BaselineCovariance() const {
  return factor_.solve(MatrixXd::Identity(gradient_.size(), gradient_.size()));
}

}  // namespace armcal
