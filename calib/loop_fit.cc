#include "calib/loop_fit.h"

#include <ceres/manifold.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>

#include <vector>

#include "problems/dense_solver.h"
#include "problems/inertial_coordinates.h"
#include "problems/inertial_manifold.h"
#include "problems/inertial_prior.h"
#include "problems/torque_factor_residual.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

LoopFit::LoopFit(const LoopUnknowns& unknowns, const LoopTrust& trust)
    : unknowns_(unknowns), inertia_(trust.inertia) {}

bool LoopFit::Solve(const MatrixXd& R, const VectorXd& z, VectorXd* x) const {
  const int links = unknowns_.links_size();
  const int others = unknowns_.size() - links;
  // Links that are held may be such as no body has.
  const bool has_links = unknowns_.is_free(0);
  std::vector<Vector10d> c;
  for (int k = 0; has_links && k < links; k += 10) {
    c.push_back(LogCholeskyFromInertial(x->segment<10>(k), 0, 0));
  }
  VectorXd y = x->tail(others);
  std::vector<double*> blocks;
  for (Vector10d& link : c) blocks.push_back(link.data());
  blocks.push_back(y.data());

  ceres::Problem problem;
  const VectorXd rest =
      has_links ? z : VectorXd(z - R.leftCols(links) * x->head(links));
  problem.AddResidualBlock(
      new TorqueFactorResidual(has_links ? R : MatrixXd(R.rightCols(others)),
                               rest, static_cast<int>(c.size()), {others}),
      nullptr, blocks);
  for (size_t i = 0; i < c.size(); ++i) {
    problem.AddResidualBlock(
        new InertialPrior(unknowns_.nominal().segment<10>(10 * i), inertia_),
        nullptr, c[i].data());
    problem.SetManifold(c[i].data(), new InertialManifold);
  }
  MatrixXd weight = MatrixXd::Zero(others, others);
  std::vector<int> held;
  for (int k = 0; k < others; ++k) {
    if (!unknowns_.is_free(links + k)) {
      held.push_back(k);
      continue;
    }
    weight(k, k) = 1 / unknowns_.prior(links + k);
    if (!unknowns_.is_positive(links + k)) continue;
    const double least = unknowns_.least(links + k);
    y[k] = std::max(y[k], least);
    problem.SetParameterLowerBound(y.data(), k, least);
  }
  problem.AddResidualBlock(
      new ceres::NormalPrior(weight, unknowns_.nominal().tail(others)), nullptr,
      y.data());
  if (static_cast<int>(held.size()) == others) {
    problem.SetParameterBlockConstant(y.data());
  } else if (!held.empty()) {
    problem.SetManifold(y.data(), new ceres::SubsetManifold(others, held));
  }
  const ceres::Solver::Summary summary = SolveDense(1e-12, &problem);
  for (size_t i = 0; i < c.size(); ++i) {
    InertialFromLogCholesky(c[i].data(), x->data() + 10 * i);
  }
  x->tail(others) = y;
  return summary.IsSolutionUsable() && x->allFinite();
}

double LoopFit::PriorCost(const VectorXd& x) const {
  double cost = 0;
  for (int k = 0; k < unknowns_.links_size() && unknowns_.is_free(0); k += 10) {
    const InertialPrior prior(unknowns_.nominal().segment<10>(k), inertia_);
    const Vector10d c = LogCholeskyFromInertial(x.segment<10>(k), 0, 0);
    const double* const block = c.data();
    VectorXd residual(prior.num_residuals());
    prior.Evaluate(&block, residual.data(), nullptr);
    cost += residual.squaredNorm();
  }
  for (int k = unknowns_.links_size(); k < unknowns_.size(); ++k) {
    if (!unknowns_.is_free(k)) continue;
    const double error = (x[k] - unknowns_.nominal()[k]) / unknowns_.prior(k);
    cost += error * error;
  }
  return cost;
}

MatrixXd LoopFit::PriorInformation(double inertia, double times) const {
  MatrixXd information = MatrixXd::Zero(unknowns_.size(), unknowns_.size());
  for (int k = 0; k < unknowns_.links_size() && unknowns_.is_free(0); k += 10) {
    const auto W =
        InertialPrior(unknowns_.nominal().segment<10>(k), inertia).W();
    information.block<10, 10>(k, k) = W.transpose() * W;
  }
  for (int k = unknowns_.links_size(); k < unknowns_.size(); ++k) {
    const double prior = times * unknowns_.prior(k);
    if (prior > 0) information(k, k) = 1 / (prior * prior);
  }
  return information;
}

}  // namespace armcal
