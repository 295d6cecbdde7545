#include "tests/benchmarks/compressed_solution.h"

#include <algorithm>

#include "calib/linear/robust_reduction.h"
#include "calib/numerics/posterior.h"
#include "model/dynamics/base_inertials.h"
#include "model/dynamics/batch_inverse_dynamics.h"
#include "problems/differential_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kInertial = SixAxisProblem::kInertial;
constexpr int kGeometric = SixAxisProblem::kGeometric;
constexpr int kSize = kInertial + kGeometric;

Trajectory MakeTrajectory(const std::vector<SixAxisSample>& samples) {
  Trajectory t;
  const auto size = static_cast<Eigen::Index>(samples.size());
  t.dt = 1e-3;
  t.q.resize(size, SixAxisProblem::kJoints);
  t.qd = t.qdd = t.tau = t.q;
  t.standstill.setConstant(size, false);
  t.core_end = static_cast<int>(size);
  for (Eigen::Index k = 0; k < size; ++k) {
    for (int j = 0; j < SixAxisProblem::kJoints; ++j) {
      t.q(k, j) = samples[k].q[j];
      t.qd(k, j) = samples[k].qd[j];
      t.qdd(k, j) = samples[k].qdd[j];
      t.tau(k, j) = samples[k].tau[j];
    }
  }
  return t;
}

}  // namespace

CompressedSolution::CompressedSolution(const SixAxisProblem& problem)
    : robot_(problem.MakeRobot()),
      geometry_(robot_),
      trajectory_(MakeTrajectory(problem.samples)),
      prior_(kSize),
      weight_(kSize) {
  const std::vector<std::string> names = geometry_.Names();
  for (const Link& link : robot_.links) {
    for (const char* name : {".a", ".alpha", ".d", ".theta"}) {
      const auto at = std::find(names.begin(), names.end(), link.name + name);
      refined_.push_back(static_cast<int>(at - names.begin()));
    }
  }
  prior_ << Eigen::Map<const VectorXd>(problem.inertial.data(), kInertial),
      Eigen::Map<const VectorXd>(problem.geometric.data(), kGeometric);
  weight_ << VectorXd::Constant(kInertial, SixAxisProblem::kInertialPrior),
      VectorXd::Constant(kGeometric, SixAxisProblem::kGeometricPrior);
  Start(prior_);
}

void CompressedSolution::Start(const VectorXd& x) {
  x_ = x;
  cost_ = CostAt(x);
}

ArmGeometry CompressedSolution::Geometry(const VectorXd& x) const {
  ArmGeometry geometry = geometry_;
  VectorXd values = geometry.Values();
  values(refined_) = x.tail(kGeometric);
  geometry.SetValues(values);
  return geometry;
}

Robot CompressedSolution::WithInertia(const VectorXd& x) const {
  Robot robot = robot_;
  for (int i = 0; i < robot.num_joints(); ++i) {
    robot.links[i].inertial =
        InertialParameters::FromVector(x.segment<10>(10 * i));
  }
  return robot;
}

MatrixXd CompressedSolution::Equations() const {
  const Robot robot = WithInertia(x_);
  const ArmGeometry geometry = Geometry(x_);
  const BaseInertials base(geometry.ApplyTo(robot));
  LinkFunctions functions(robot, {}, geometry, refined_, base.columns);
  functions.Enter(trajectory_);
  RowOptions options;
  options.identification = Identification::kDifferential;
  VectorXd x(functions.size());
  x << base.combinations * x_.head(kInertial), x_.tail(kGeometric);
  RobustReduction reduction(
      {x, kGeometric, VectorXd::Ones(SixAxisProblem::kJoints),
       RobustLoss::kSquared, false},
      functions, RowsPerLeaf(options));
  reduction.Add(DifferentialRows(trajectory_, options, functions),
                std::vector<bool>(SixAxisProblem::kJoints, true));
  const MatrixXd triangle = reduction.Triangle();
  MatrixXd equations(triangle.rows(), kSize + 1);
  equations << triangle.leftCols(base.columns.size()) * base.combinations,
      triangle.rightCols(kGeometric + 1);
  return equations;
}

double CompressedSolution::CostAt(const VectorXd& x) const {
  const BatchInverseDynamics dynamics(Geometry(x).ApplyTo(WithInertia(x)));
  MatrixXd tau = trajectory_.tau;
  std::vector<double*> columns;
  for (int j = 0; j < tau.cols(); ++j) columns.push_back(tau.col(j).data());
  const Trajectory& t = trajectory_;
  dynamics.Torque({t.q, t.qd, t.qdd, {}}, t.size(), columns.data());
  return .5 * (tau - t.tau).squaredNorm() +
         .5 * weight_.cwiseProduct(x - prior_).squaredNorm();
}

bool CompressedSolution::Iterate() {
  TriangularFactor factor(kSize);
  const MatrixXd equations = Equations();
  factor.AddRows(equations.data(), equations.rows(), equations.rows());
  MatrixXd prior = MatrixXd::Zero(kSize, kSize + 1);
  prior.diagonal() = weight_;
  prior.col(kSize) = weight_.cwiseProduct(prior_);
  factor.AddRows(prior.data(), kSize, kSize);
  const MatrixXd& R = factor.Triangle();
  const VectorXd step = R.topLeftCorner(kSize, kSize)
                            .triangularView<Eigen::Upper>()
                            .solve(R.col(kSize).head(kSize)) -
                        x_;
  for (double part = 1; part > 1e-3; part /= 2) {
    const VectorXd next = x_ + part * step;
    const double cost = CostAt(next);
    if (!(cost < cost_)) continue;
    x_ = next;
    cost_ = cost;
    return true;
  }
  return false;
}

MatrixXd CompressedSolution::Covariance() const {
  std::vector<int> all(kSize);
  for (int k = 0; k < kSize; ++k) all[k] = k;
  return Posterior(Equations().leftCols(kSize),
                   weight_.cwiseAbs2().asDiagonal(), all)
      .Gain();
}

}  // namespace armcal
