#include "calib/gap_screen.h"

#include <glog/logging.h>

#include <cmath>

#include "model/dense_solvers.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

GapScreen::GapScreen(std::vector<MatrixXd> baseline, JointRows target)
    : baseline_(std::move(baseline)), target_(std::move(target)) {
  CHECK_EQ(baseline_.size(), target_.size());
  const Eigen::Index size = baseline_.at(0).cols();
  information_ = MatrixXd::Identity(size, size);
  gradient_ = VectorXd::Zero(size);
  for (size_t j = 0; j < baseline_.size(); ++j) {
    CHECK_EQ(baseline_[j].rows(), target_[j].size());
    information_ += baseline_[j].transpose() * baseline_[j];
    gradient_ += baseline_[j].transpose() * target_[j];
  }
}

void GapScreen::AddInformation(const MatrixXd& AtA, const VectorXd& Aty) {
  CHECK_EQ(known_.size(), 0);
  information_ += AtA;
  gradient_ += Aty;
  // The root of a matrix that may be singular, which a triangular one of it
  // would not survive: A'A = U'U with U = sqrt(values) vectors'.
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(AtA);
  const VectorXd values = eigen.eigenvalues();
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

void GapScreen::Factor() {
  const int count = size();
  factor_.compute(information_);
  cross_ = MatrixXd::Zero(gradient_.size(), count);
  G_ = MatrixXd::Zero(count, count);
  g_ = VectorXd::Zero(count);
  for (size_t j = 0; j < target_.size(); ++j) {
    std::vector<int> here;
    for (int c = 0; c < count; ++c) {
      if (columns_[c][j].size() > 0) here.push_back(c);
    }
    MatrixXd C(target_[j].size(), here.size());
    for (size_t k = 0; k < here.size(); ++k) C.col(k) = columns_[here[k]][j];
    const MatrixXd products = C.transpose() * C;
    const MatrixXd cross = baseline_[j].transpose() * C;
    const VectorXd with_target = C.transpose() * target_[j];
    for (size_t k = 0; k < here.size(); ++k) {
      cross_.col(here[k]) += cross.col(k);
      g_[here[k]] += with_target[k];
      for (size_t l = 0; l < here.size(); ++l) {
        G_(here[k], here[l]) += products(k, l);
      }
    }
  }
  raw_ = G_.diagonal();
  const MatrixXd half = factor_.matrixL().solve(cross_);
  const VectorXd known = factor_.matrixL().solve(gradient_);
  G_ -= half.transpose() * half;
  g_ -= half.transpose() * known;
}

VectorXd GapScreen::Gradient(const JointRows& target) const {
  VectorXd g = VectorXd::Zero(size());
  VectorXd gradient = VectorXd::Zero(gradient_.size());
  for (size_t j = 0; j < target.size(); ++j) {
    gradient += baseline_[j].transpose() * target[j];
    for (int c = 0; c < size(); ++c) {
      if (columns_[c][j].size() > 0) g[c] += columns_[c][j].dot(target[j]);
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
