#include "calib/closed_loop/fit.h"

#include <algorithm>
#include <vector>

#include "calib/refine/link_start.h"
#include "problems/inertial_coordinates.h"
#include "problems/inertial_prior.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

LoopFit::LoopFit(const LoopUnknowns& unknowns, const LoopTrust& trust,
                 const TorqueInformation* torques)
    : unknowns_(unknowns),
      torques_(torques),
      inertia_(trust.inertia),
      files_(unknowns.nominal()) {
  constexpr double kInside = .01;  // m, kg
  for (int k = 0; k < unknowns.links_size(); k += 10) {
    if (!unknowns.is_free(k)) continue;
    const Vector10d c =
        LogCholeskyFromInertial(files_.segment<10>(k), kInside, kInside);
    InertialFromLogCholesky(c.data(), files_.data() + k);
  }
}

// Links that are held may be such as no body has.
std::vector<int> LoopFit::HeldLinks() const {
  std::vector<int> indices;
  for (int k = 0; k < unknowns_.links_size(); ++k) {
    if (!unknowns_.is_free(k)) indices.push_back(k);
  }
  return indices;
}

std::vector<int> LoopFit::Asked() const {
  std::vector<int> indices;
  for (int k = 0; k < unknowns_.size(); ++k) {
    if (k >= unknowns_.links_size() || unknowns_.is_free(k)) {
      indices.push_back(k);
    }
  }
  return indices;
}

MatrixXd LoopFit::TorqueRows() const {
  if (torques_ == nullptr) return MatrixXd::Zero(0, unknowns_.size());
  MatrixXd rows = MatrixXd::Zero(torques_->R.rows(), unknowns_.size());
  rows.leftCols(torques_->R.cols()) = torques_->R;
  return rows;
}

MatrixXd LoopFit::TorqueScores() const {
  MatrixXd scores = MatrixXd::Zero(unknowns_.size(), unknowns_.size());
  if (torques_ == nullptr) return scores;
  scores.topLeftCorner(torques_->S.rows(), torques_->S.cols()) = torques_->S;
  return scores;
}

// The equations of the loop, those of torques and the normal priors, each a
// block of rows of A x = b; links have their divergence in StartLinks, for
// which all of this is one convex problem. Links that are held are moved to the
// right side.
bool LoopFit::Solve(const MatrixXd& R, const VectorXd& z, VectorXd* x) const {
  constexpr double kClear = 1e-6;  // of its prior, a start of what is positive
  const int links = unknowns_.links_size();
  const int others = unknowns_.size() - links;
  const std::vector<int> held = HeldLinks(), asked = Asked();
  const auto size = static_cast<Eigen::Index>(asked.size());
  const MatrixXd by_torque = TorqueRows();
  const long told = R.rows() + by_torque.rows();
  MatrixXd all(told, unknowns_.size());
  all << R, by_torque;
  MatrixXd A = MatrixXd::Zero(told + others, size);
  VectorXd b = VectorXd::Zero(A.rows());
  A.topRows(told) = all(Eigen::all, asked);
  b.head(R.rows()) = z;
  if (torques_ != nullptr) {
    b.segment(R.rows(), torques_->z.size()) = torques_->z;
  }
  b.head(told) -= all(Eigen::all, held) * (*x)(held);
  VectorXd start = files_(asked);
  std::vector<TermRange> ranges;
  for (int k = 0; k < others; ++k) {
    const int unknown = links + k;
    ranges.push_back(!unknowns_.is_free(unknown)      ? TermRange::kHeld
                     : unknowns_.is_positive(unknown) ? TermRange::kPositive
                                                      : TermRange::kFree);
    double& value = start[size - others + k];
    value = (*x)[unknown];
    if (ranges.back() == TermRange::kHeld) continue;
    const double prior = unknowns_.prior(unknown);
    A(told + k, size - others + k) = 1 / prior;
    b[told + k] = files_[unknown] / prior;
    if (ranges.back() == TermRange::kPositive) {
      value = std::max(value, kClear * prior);
    }
  }
  const auto solved =
      StartLinks(A, b, inertia_ > 0 ? inertia_ : 1, ranges, start);
  if (!solved) return false;
  (*x)(asked) = *solved;
  for (int k = links; k < unknowns_.size(); ++k) {
    if (unknowns_.is_free(k) && unknowns_.is_positive(k)) {
      (*x)[k] = std::max((*x)[k], unknowns_.least(k));
    }
  }
  return true;
}

// The same costs as Solve() minimises, but those of R: what a line search
// weighs against the simulation's residuals.
double LoopFit::PriorCost(const VectorXd& x) const {
  double cost = 0;
  if (torques_ != nullptr) {
    cost +=
        (torques_->R * x.head(torques_->R.cols()) - torques_->z).squaredNorm();
  }
  for (int k = 0; k < unknowns_.links_size(); k += 10) {
    if (!unknowns_.is_free(k)) continue;
    const InertialPrior prior(files_.segment<10>(k), inertia_);
    const Vector10d c = LogCholeskyFromInertial(x.segment<10>(k), 0, 0);
    const double* const block = c.data();
    VectorXd residual(prior.num_residuals());
    prior.Evaluate(&block, residual.data(), nullptr);
    cost += residual.squaredNorm();
  }
  for (int k = unknowns_.links_size(); k < unknowns_.size(); ++k) {
    if (!unknowns_.is_free(k)) continue;
    const double error = (x[k] - files_[k]) / unknowns_.prior(k);
    cost += error * error;
  }
  return cost;
}

MatrixXd LoopFit::PriorInformation(double inertia, double times) const {
  MatrixXd information = MatrixXd::Zero(unknowns_.size(), unknowns_.size());
  for (int k = 0; k < unknowns_.links_size(); k += 10) {
    if (!unknowns_.is_free(k)) continue;
    const auto W = InertialPrior(files_.segment<10>(k), inertia).W();
    information.block<10, 10>(k, k) = W.transpose() * W;
  }
  for (int k = unknowns_.links_size(); k < unknowns_.size(); ++k) {
    const double prior = times * unknowns_.prior(k);
    if (prior > 0) information(k, k) = 1 / (prior * prior);
  }
  return information;
}

}  // namespace armcal
