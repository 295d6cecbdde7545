#include "calib/diagnose/data/screen.h"

#include <glog/logging.h>
#include <tbb/parallel_for.h>

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

GapScreen::GapScreen(std::vector<MatrixXd> baseline, JointRows target)
    : baseline_(std::move(baseline)), target_(std::move(target)) {
  CHECK_EQ(baseline_.size(), target_.size());
  const Eigen::Index size = baseline_.at(0).cols();
  information_ = MatrixXd::Identity(size, size);
  gradient_ = VectorXd::Zero(size);
  for (size_t j = 0; j < baseline_.size(); ++j) {
    CHECK_EQ(baseline_[j].rows(), target_[j].size());
    information_ += InnerProducts(baseline_[j], baseline_[j]);
    gradient_ += baseline_[j].transpose() * target_[j];
  }
}

void GapScreen::AddInformation(const MatrixXd& AtA, const VectorXd& Aty) {
  CHECK_EQ(known_.size(), 0);
  CHECK_LT(factored_, 0);
  information_ += AtA;
  gradient_ += Aty;
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

GapScreen::Products GapScreen::ProductsOf(int joint) const {
  Products products;
  for (int c = 0; c < size(); ++c) {
    if (columns_[c][joint].size() == 0) continue;
    products.all.push_back(c);
    if (c >= factored_) products.added.push_back(c);
  }
  if (products.added.empty()) return products;
  MatrixXd C(target_[joint].size(), products.all.size());
  for (size_t k = 0; k < products.all.size(); ++k) {
    C.col(k) = columns_[products.all[k]][joint];
  }
  const MatrixXd added = C.rightCols(products.added.size());
  products.by_columns = InnerProducts(C, added);
  products.by_baseline = InnerProducts(baseline_[joint], added);
  products.by_target = added.transpose() * target_[joint];
  return products;
}

void GapScreen::Factor() {
  if (factored_ < 0) {
    factor_.compute(information_);
    factored_ = 0;
  }
  const int before = factored_, count = size(), more = count - before;
  std::vector<Products> products(target_.size());
  tbb::parallel_for(size_t{0}, products.size(), [&](size_t j) {
    products[j] = ProductsOf(static_cast<int>(j));
  });
  cross_.conservativeResize(gradient_.size(), count);
  cross_.rightCols(more).setZero();
  // All columns by the new ones.
  MatrixXd G = MatrixXd::Zero(count, more);
  VectorXd g = VectorXd::Zero(more);
  for (const Products& own : products) {
    for (size_t k = 0; k < own.added.size(); ++k) {
      const int c = own.added[k];
      cross_.col(c) += own.by_baseline.col(k);
      g[c - before] += own.by_target[k];
      for (size_t l = 0; l < own.all.size(); ++l) {
        G(own.all[l], c - before) += own.by_columns(l, k);
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
      gradient.col(p) +=
          baseline_[j].middleRows(begin, count).transpose() * here;
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
      cross.col(a) += baseline_[j].transpose() * column;
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
  VectorXd residual = target_[joint] - baseline_[joint] * Baseline(fit);
  for (size_t k = 0; k < fit.columns.size(); ++k) {
    const VectorXd& column = columns_[fit.columns[k]][joint];
    if (column.size() > 0) residual -= fit.coefficients[k] * column;
  }
  return residual;
}

VectorXd GapScreen::BaselineBeside(const JointRows& torque) const {
  VectorXd gradient = gradient_;
  for (size_t j = 0; j < target_.size(); ++j) {
    if (torque[j].size() > 0) {
      gradient -= baseline_[j].transpose() * torque[j];
    }
  }
  return factor_.solve(gradient);
}

VectorXd GapScreen::ResidualBeside(const JointRows& torque) const {
  const VectorXd x = BaselineBeside(torque);
  Eigen::Index rows = x.size() + known_.size();
  for (const VectorXd& target : target_) rows += target.size();
  VectorXd residual(rows);
  Eigen::Index at = 0;
  for (size_t j = 0; j < target_.size(); ++j) {
    auto here = residual.segment(at, target_[j].size());
    here = target_[j] - baseline_[j] * x;
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
      -baseline_[joint] * factor_.solve(VectorXd(cross_.col(column)));
  const VectorXd& own = columns_[column][joint];
  if (own.size() > 0) projected += own;
  return projected;
}

MatrixXd GapScreen::BaselineCovariance() const {
  return factor_.solve(MatrixXd::Identity(gradient_.size(), gradient_.size()));
}

}  // namespace armcal
