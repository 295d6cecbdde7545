#include "calib/diagnose/data/baseline_fit.h"

#include <glog/logging.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/diagnose/data/inner_products.h"
#include "model/signals/dense_solvers.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// As few rows with the same products, by the root of a matrix that may be
// singular, which a triangular one would not survive:
//   A'A = V diag(values) V' = U'U, U = diag(sqrt(values)) V', and U^-T A'y.
BaselineFit::Rows Root(const BaselineFit::Rows& rows) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(rows.of_columns);
  const VectorXd& values = eigen.eigenvalues();
  BaselineFit::Rows root = rows;
  root.columns.values = eigen.eigenvectors().transpose();
  root.target = root.columns.values * rows.of_target;
  const double least =
      values.size() > 0 ? 1e-14 * values.cwiseAbs().maxCoeff() : 0;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    const double size = values[k] > least ? std::sqrt(values[k]) : 0;
    root.columns.values.row(k) *= size;
    root.target[k] = size > 0 ? root.target[k] / size : 0;
  }
  return root;
}

}  // namespace

void BaselineFit::Rows::Multiply() {
  CHECK_EQ(columns.values.rows(), target.size());
  of_columns = InnerProductsWithLast(columns.values, columns.values.cols());
  of_target = columns.values.transpose() * target;
  target_squared = target.squaredNorm();
}

BaselineFit::BaselineFit(std::vector<BaselineColumns> columns, int size,
                         JointRows target, ColumnPrior prior)
    : known_(std::make_shared<const std::vector<Rows>>()),
      prior_(std::move(prior)),
      weight_(VectorXd::Ones(target.size())),
      scale_(VectorXd::Ones(size)) {
  CHECK_EQ(columns.size(), target.size());
  std::vector<Rows> rows(target.size());
  tbb::parallel_for(size_t{0}, rows.size(), [&](size_t j) {
    rows[j] = {std::move(columns[j]), std::move(target[j]), {}, {}};
    rows[j].Multiply();
  });
  rows_ = std::make_shared<const std::vector<Rows>>(std::move(rows));
  FindArms();
}

void BaselineFit::AddKnown(const std::vector<BaselineColumns>& columns,
                           const JointRows& target) {
  CHECK(known_->empty());
  std::vector<Rows> known(columns.size());
  tbb::parallel_for(size_t{0}, known.size(), [&](size_t j) {
    known[j] = {columns[j], target[j], {}, {}};
    known[j].Multiply();
    known[j] = Root(known[j]);
  });
  known_ = std::make_shared<const std::vector<Rows>>(std::move(known));
  FindArms();
}

// Which columns act on one joint alone, in these data and in others, and are no
// part of the prior's correlations: those are the joint's arm. Sorted so, the
// information matrix is an arrow, block diagonal but for the columns that
// joints share, and its factor costs the cube of an arm's size per joint
// instead of the cube of all columns. A calibration's prior ties its columns to
// each other, whose joints are then shared.
void BaselineFit::FindArms() {
  constexpr int kNone = -1, kSeveral = -2;
  std::vector<int> joint_of(size(), kNone);
  for (const int c : prior_.which()) joint_of[c] = kSeveral;
  for (const std::vector<Rows>* data : {rows_.get(), known_.get()}) {
    for (int j = 0; j < static_cast<int>(data->size()); ++j) {
      for (const int c : (*data)[j].columns.which) {
        const bool is_first = joint_of[c] == kNone || joint_of[c] == j;
        joint_of[c] = is_first ? j : kSeveral;
      }
    }
  }
  arms_.assign(num_joints(), {});
  std::vector<int> at(size());
  int common = 0;
  for (int c = 0; c < size(); ++c) {
    if (joint_of[c] < 0) {
      at[c] = common++;
      continue;
    }
    std::vector<int>& arm = arms_[joint_of[c]];
    at[c] = static_cast<int>(arm.size());
    arm.push_back(c);
  }
  places_.assign(num_joints(), {});
  for (int j = 0; j < num_joints(); ++j) {
    const std::vector<int>& which = rows(j).columns.which;
    for (int k = 0; k < static_cast<int>(which.size()); ++k) {
      const bool is_own = joint_of[which[k]] == j;
      (is_own ? places_[j].own : places_[j].shared).push_back(k);
      (is_own ? places_[j].in_arm : places_[j].in_common)
          .push_back(at[which[k]]);
    }
  }
}

void BaselineFit::Weigh(const VectorXd& factor) {
  CHECK_EQ(factor.size(), num_joints());
  weight_ = weight_.cwiseProduct(factor);
}

void BaselineFit::Scale(const std::vector<int>& which, double factor) {
  scale_(which) *= factor;
}

VectorXd BaselineFit::ScaleOf(int joint) const {
  return weight_[joint] * scale_(rows(joint).columns.which);
}

// The information on the first `columns` of the baseline,
//   precision of the prior + sum_j S_j A_j' A_j S_j,
// A_j the whitened columns of joint j and S_j their scales. Products are summed
// once, so that weighing rows again is one product with their squared weights.
MatrixXd BaselineFit::Information(int columns) const {
  MatrixXd information = prior_.Precision(columns);
  const auto add = [&](const Rows& rows, double weight) {
    const std::vector<int>& all = rows.columns.which;
    const std::vector<int> which(
        all.begin(), std::lower_bound(all.begin(), all.end(), columns));
    const Eigen::Index count = static_cast<Eigen::Index>(which.size());
    const VectorXd scale = weight * scale_(which);
    information(which, which) += scale.asDiagonal() *
                                 rows.of_columns.topLeftCorner(count, count) *
                                 scale.asDiagonal();
  };
  for (int j = 0; j < num_joints(); ++j) add(rows(j), weight_[j]);
  for (const Rows& known : *known_) add(known, 1);
  return information;
}

// The normal equations of the fit: their right-hand side is the prior's
// precision times its mean, plus the columns' products with the target. They
// are factored as an arrow; the gradient of each arm is solved there, and what
// is left for the shared columns follows from it (the Schur complement), so
// that a further right-hand side touches only the arm that it is of.
void BaselineFit::Factor() {
  gradient_ = prior_.PrecisionTimesMean(size());
  for (int j = 0; j < num_joints(); ++j) {
    gradient_(rows(j).columns.which) +=
        weight_[j] * ScaleOf(j).cwiseProduct(rows(j).of_target);
  }
  for (const Rows& known : *known_) {
    const std::vector<int>& which = known.columns.which;
    gradient_(which) += scale_(which).cwiseProduct(known.of_target);
  }
  factor_ = ArrowFactor(Information(size()), arms_);
  common_gradient_ = gradient_(factor_.common());
  arm_gradient_.resize(arms_.size());
  for (int j = 0; j < num_joints(); ++j) {
    arm_gradient_[j] = factor_.HalfOfArm(j, gradient_(arms_[j]));
    common_gradient_ -= factor_.coupling(j).transpose() * arm_gradient_[j];
  }
  common_gradient_ = factor_.HalfOfCommon(common_gradient_);
}

VectorXd BaselineFit::Torque(int joint, const VectorXd& x) const {
  return weight_[joint] * rows(joint).columns.Times(scale_.cwiseProduct(x));
}

void BaselineFit::AddProducts(int joint, const VectorXd& torque,
                              Eigen::Ref<VectorXd> products) const {
  const BaselineColumns& own = rows(joint).columns;
  const VectorXd unscaled = own.values.transpose() * torque;
  products(own.which) += ScaleOf(joint).cwiseProduct(unscaled);
}

VectorXd BaselineFit::KnownResidual(const VectorXd& x) const {
  Eigen::Index count = 0, at = 0;
  for (const Rows& known : *known_) count += known.target.size();
  VectorXd residual(count);
  for (const Rows& known : *known_) {
    residual.segment(at, known.target.size()) =
        known.columns.Times(scale_.cwiseProduct(x)) - known.target;
    at += known.target.size();
  }
  return residual;
}

VectorXd BaselineFit::GradientGiven(const JointRows& torque) const {
  VectorXd taken = VectorXd::Zero(size());
  for (int j = 0; j < num_joints(); ++j) {
    if (torque[j].size() > 0) AddProducts(j, torque[j], taken);
  }
  return gradient_ - taken;
}

// The values of the baseline that fit the data best if this torque is there as
// well: its products are taken off the right-hand side, and the factor stays.
VectorXd BaselineFit::ValuesGiven(const JointRows& torque) const {
  return factor_.Solve(GradientGiven(torque));
}

VectorXd BaselineFit::ValuesGiven(const JointRows& torque, int columns) const {
  VectorXd x = VectorXd::Zero(size());
  x.head(columns) =
      Information(columns).llt().solve(GradientGiven(torque).head(columns));
  return x;
}

// All that a least squares fit leaves, in units of its standard deviations: the
// rows of all joints, what the values differ from their prior by, and what
// other data have of them. Its squared norm is chi squared, in which a torque
// that the prior would have to explain costs as much as one that the data
// would.
VectorXd BaselineFit::ResidualGiven(const JointRows& torque) const {
  const VectorXd x = ValuesGiven(torque), known = KnownResidual(x);
  Eigen::Index count = x.size() + known.size(), at = 0;
  for (const Rows& own : *rows_) count += own.target.size();
  VectorXd residual(count);
  for (int j = 0; j < num_joints(); ++j) {
    const VectorXd& target = rows(j).target;
    auto here = residual.segment(at, target.size());
    here = weight_[j] * target - Torque(j, x);
    if (torque[j].size() > 0) here -= torque[j];
    at += target.size();
  }
  residual.segment(at, x.size()) = prior_.Residual(x);
  residual.tail(known.size()) = known;
  return residual;
}

// How many of joint j's rows the baseline fits: tr(A_j C A_j'), C the
// covariance of its values, which is the trace of the product of its
// information with C. It is the effective number of parameters of a penalised
// fit (Hastie, Tibshirani and Friedman 2009, 7.6). Only C between the joint's
// arm and the shared columns is needed, which the arrow's factor has without
// inverting the rest.
VectorXd BaselineFit::FittedRows() const {
  VectorXd fitted(num_joints());
  for (int j = 0; j < num_joints(); ++j) {
    const Places& places = places_[j];
    // Where the joint's columns are in InverseBeside.
    std::vector<int> at(places.own.size() + places.shared.size());
    for (size_t k = 0; k < places.own.size(); ++k) {
      at[places.own[k]] = places.in_arm[k];
    }
    const int arm = static_cast<int>(arms_[j].size());
    for (size_t k = 0; k < places.shared.size(); ++k) {
      at[places.shared[k]] = arm + places.in_common[k];
    }
    const VectorXd scale = ScaleOf(j);
    const MatrixXd information =
        scale.asDiagonal() * rows(j).of_columns * scale.asDiagonal();
    fitted[j] =
        information.cwiseProduct(factor_.InverseBeside(j)(at, at)).sum();
  }
  return fitted;
}

MatrixXd BaselineFit::Covariance() const {
  return factor_.Solve(MatrixXd::Identity(size(), size()));
}

}  // namespace armcal
