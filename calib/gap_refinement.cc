#include "calib/gap_refinement.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "calib/gap_coordinates.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostIterations = 12;

class ProjectedResidual {
 public:
  ProjectedResidual(const GapScreen& screen, const GapBaseline& baseline,
                    const MotionScale& scale, std::vector<GapCandidate> effects,
                    std::vector<Coordinate> coordinates, GapData* data)
      : screen_(screen),
        baseline_(baseline),
        scale_(scale),
        effects_(std::move(effects)),
        coordinates_(std::move(coordinates)),
        data_(data) {}

  std::vector<GapCandidate> At(const double* u) const {
    std::vector<GapCandidate> effects = effects_;
    for (size_t k = 0; k < coordinates_.size(); ++k) {
      const Coordinate& c = coordinates_[k];
      effects[c.effect].p[c.parameter] = c.Value(u[k]);
    }
    return effects;
  }
  JointRows Torque(const double* u) const {
    return WhitenEach(data_->rows(),
                      EffectTorque(baseline_, scale_, At(u), data_));
  }
  bool operator()(double const* const* u, double* residuals) const {
    const VectorXd r = screen_.ResidualBeside(Torque(u[0]));
    if (!r.allFinite()) return false;
    Eigen::Map<VectorXd>(residuals, r.size()) = r;
    return true;
  }

 private:
  const GapScreen& screen_;
  const GapBaseline& baseline_;
  const MotionScale& scale_;
  std::vector<GapCandidate> effects_;
  std::vector<Coordinate> coordinates_;
  GapData* data_;
};

void SetBounds(const std::vector<Coordinate>& coordinates, double* u,
               ceres::Problem* problem) {
  for (size_t k = 0; k < coordinates.size(); ++k) {
    const Coordinate& c = coordinates[k];
    const int index = static_cast<int>(k);
    if (std::isfinite(c.low)) {
      u[k] = std::max(u[k], c.Inverse(c.low));
      problem->SetParameterLowerBound(u, index, c.Inverse(c.low));
    }
    if (std::isfinite(c.high)) {
      u[k] = std::min(u[k], c.Inverse(c.high));
      problem->SetParameterUpperBound(u, index, c.Inverse(c.high));
    }
  }
}

// (J'J)^-1 in the units of p, without the directions that bounds hold.
MatrixXd CovarianceAt(const ceres::CostFunction& cost,
                      const std::vector<Coordinate>& coordinates,
                      const VectorXd& u) {
  const int size = static_cast<int>(u.size());
  VectorXd residual(cost.num_residuals());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J(
      cost.num_residuals(), size);
  const double* block = u.data();
  double* jacobian = J.data();
  MatrixXd covariance = MatrixXd::Zero(size, size);
  if (!cost.Evaluate(&block, residual.data(), &jacobian)) return covariance;
  std::vector<int> free;
  for (int k = 0; k < size; ++k) {
    if (!coordinates[k].AtBound(u[k]) && J.col(k).squaredNorm() > 0) {
      free.push_back(k);
    }
  }
  if (free.empty()) return covariance;
  MatrixXd information(free.size(), free.size());
  for (size_t a = 0; a < free.size(); ++a) {
    for (size_t b = 0; b < free.size(); ++b) {
      information(a, b) = J.col(free[a]).dot(J.col(free[b]));
    }
  }
  const MatrixXd inverse =
      information.completeOrthogonalDecomposition().pseudoInverse();
  for (size_t a = 0; a < free.size(); ++a) {
    for (size_t b = 0; b < free.size(); ++b) {
      covariance(free[a], free[b]) = inverse(a, b) *
                                     coordinates[free[a]].Slope(u[free[a]]) *
                                     coordinates[free[b]].Slope(u[free[b]]);
    }
  }
  return covariance;
}

// From coordinates to all parameters one after the other.
MatrixXd Spread(const std::vector<GapCandidate>& effects,
                const std::vector<Coordinate>& coordinates,
                const MatrixXd& covariance) {
  std::vector<int> begin = {0};
  for (const GapCandidate& effect : effects) {
    begin.push_back(begin.back() + static_cast<int>(effect.p.size()));
  }
  MatrixXd all = MatrixXd::Zero(begin.back(), begin.back());
  for (size_t a = 0; a < coordinates.size(); ++a) {
    for (size_t b = 0; b < coordinates.size(); ++b) {
      all(begin[coordinates[a].effect] + coordinates[a].parameter,
          begin[coordinates[b].effect] + coordinates[b].parameter) =
          covariance(a, b);
    }
  }
  return all;
}

}  // namespace

JointRows EffectTorque(const GapBaseline& baseline, const MotionScale& scale,
                       const std::vector<GapCandidate>& effects,
                       GapData* data) {
  const GapRows& rows = data->rows();
  JointRows thin(rows.num_joints());
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i), log = rows.segments()[i].log;
    SimulatedRobot changed;
    changed.robot = baseline.robot();
    for (const GapCandidate& effect : effects) {
      if (!effect.IsIn(log)) continue;
      effect.effect->apply({&baseline.robot(), effect.joint, &scale}, effect.p,
                           &changed);
    }
    AddThinned(rows, s, (*data->mutable_torques())[i].Change(changed), &thin);
  }
  return thin;
}

JointRows WhitenEach(const GapRows& rows, const JointRows& thin) {
  JointRows white(thin.size());
  for (size_t j = 0; j < thin.size(); ++j) {
    if (thin[j].size() == 0) continue;
    white[j] = rows.Whiten(static_cast<int>(j), thin[j]);
  }
  return white;
}

RefinedEffects RefineEffects(const GapScreen& screen,
                             const GapBaseline& baseline,
                             const MotionScale& scale,
                             std::vector<GapCandidate> effects, int only,
                             GapData* data) {
  RefinedEffects refined;
  refined.effects = effects;
  const std::vector<Coordinate> coordinates =
      ListCoordinates(baseline, scale, effects, only);
  const int size = static_cast<int>(coordinates.size());
  const auto residual = new ProjectedResidual(screen, baseline, scale, effects,
                                              coordinates, data);
  ceres::NumericDiffOptions steps;
  steps.relative_step_size = 1e-4;
  auto* cost = new ceres::DynamicNumericDiffCostFunction<ProjectedResidual,
                                                         ceres::FORWARD>(
      residual, ceres::TAKE_OWNERSHIP, steps);
  VectorXd u = VectorXd::Ones(size);
  cost->AddParameterBlock(size);
  cost->SetNumResiduals(static_cast<int>(
      screen.ResidualBeside(residual->Torque(u.data())).size()));
  ceres::Problem problem;
  problem.AddResidualBlock(cost, nullptr, u.data());
  SetBounds(coordinates, u.data(), &problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = kMostIterations;
  options.function_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  refined.effects = residual->At(u.data());
  refined.covariance =
      Spread(effects, coordinates, CovarianceAt(*cost, coordinates, u));
  refined.baseline = screen.BaselineBeside(residual->Torque(u.data()));
  refined.drop =
      screen.ResidualBeside(JointRows(screen.num_joints())).squaredNorm() -
      2 * summary.final_cost;
  return refined;
}

}  // namespace armcal
