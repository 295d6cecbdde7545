#include "calib/nonlinear_calibration.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/link_start.h"
#include "calib/robust_rows.h"
#include "calib/triangular_factor.h"
#include "problems/inertial_coordinates.h"
#include "problems/inertial_manifold.h"
#include "problems/inertial_prior.h"
#include "problems/link_functions.h"
#include "problems/torque_factor_residual.h"
#include "problems/weak_rows.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The four terms of every joint, in the order of the parameters.
std::vector<JointTermColumn> AllTerms(const LinearCalibration& linear) {
  std::vector<JointTermColumn> terms;
  for (int j = 0; j < linear.parameters.num_joints(); ++j) {
    for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb,
                                 JointTerm::kOffset, JointTerm::kArmature}) {
      JointTermColumn column{j, term, {}};
      if (!linear.transitions.empty()) {
        column.transition = linear.transitions[j];
      }
      terms.push_back(column);
    }
  }
  return terms;
}

double* TermOf(JointTerm term, Joint* joint) {
  switch (term) {
    case JointTerm::kViscous:
      return &joint->viscous;
    case JointTerm::kCoulomb:
      return &joint->coulomb;
    case JointTerm::kOffset:
      return &joint->offset;
    case JointTerm::kArmature:
      return &joint->armature;
  }
  return nullptr;
}

class PhysicalCalibrator {
 public:
  PhysicalCalibrator(const Robot& robot, const LinearCalibration& linear,
                     const NonlinearCalibrationOptions& options)
      : robot_(robot),
        linear_(linear),
        options_(options),
        links_(robot.num_joints()),
        terms_(AllTerms(linear)),
        nominal_(StackInertials(robot)) {
    for (JointTermColumn& t : terms_) {
      term_start_.push_back(*TermOf(t.term, &robot_.links[t.joint].joint));
      held_.push_back(std::count(linear.joint_terms.begin(),
                                 linear.joint_terms.end(), t.term) == 0);
    }
    for (int k = 0; k < linear.parameters.size(); ++k) {
      const ModelParameter& p = linear.parameters.parameters()[k];
      if (!p.is_joint_term) continue;
      for (size_t t = 0; t < terms_.size(); ++t) {
        if (terms_[t].joint == p.block && terms_[t].term == p.term) {
          term_start_[t] = linear.x[k];
        }
      }
    }
  }

  NonlinearCalibration Run(LogSet* training, LogSet* validation);

 private:
  int num_terms() const { return static_cast<int>(terms_.size()); }
  void Reduce(LogSet* training);
  struct Estimate {
    std::vector<Vector10d> links;  // log-Cholesky coordinates
    std::vector<double> terms;
  };
  ceres::Solver::Summary SolveAt(double trust, Estimate* estimate) const;
  bool Solve(NonlinearCalibration* result) const;
  MatrixXd Covariance(const std::vector<int>& free, double trust) const;
  void Report(const VectorXd& V, const std::vector<double>& terms,
              NonlinearCalibration* result) const;
  TorqueResidual Evaluate(const Robot& robot, LogSet* logs) const;

  Robot robot_;
  const LinearCalibration& linear_;
  const NonlinearCalibrationOptions& options_;
  int links_;
  std::vector<JointTermColumn> terms_;
  VectorXd nominal_;                // stacked inertials of the file
  std::vector<double> term_start_;  // joint terms
  std::vector<bool> held_;          // per joint term
  MatrixXd R_;                      // whitened equations R x = z
  VectorXd z_;
};

// One pass: all joints' equations in whitened form. Rows that overlap and whose
// errors are autocorrelated tell less than their number: `inflation`.
void PhysicalCalibrator::Reduce(LogSet* training) {
  const ArmGeometry geometry(robot_);
  TriangularFactor factor(10 * links_ + num_terms());
  std::vector<MotionRegressor> model(training->size(),
                                     MotionRegressor(linear_.parameters));
  std::vector<LinkFunctions> links(training->size(),
                                   LinkFunctions(robot_, terms_, geometry, {}));
  training->ForEach(
      "links", options_.progress, [&](int log, const Trajectory& t) {
        std::vector<VectorXd> weights;
        ForEachRow(
            t, linear_.rows, &model[log], [&](const IdentificationRow& row) {
              VectorXd w =
                  (row.Y - row.U * linear_.x).cwiseQuotient(linear_.noise);
              for (int i = 0; i < w.size(); ++i) {
                w[i] = linear_.used[log][i]
                           ? std::sqrt(Huber::Weight(w[i])) /
                                 (linear_.noise[i] * linear_.inflation)
                           : 0;
              }
              weights.push_back(w);
            });
        size_t next = 0;
        links[log].Enter(t);
        ForEachWeakRow(t, linear_.rows, &links[log],
                       [&](const IdentificationRow& row) {
                         const VectorXd& w = weights[next++];
                         for (int i = 0; i < w.size(); ++i) {
                           if (w[i] > 0)
                             factor.Add(row.U.row(i), row.Y[i], w[i]);
                         }
                       });
      });
  const MatrixXd triangle = factor.Triangle();
  R_ = triangle.topLeftCorner(factor.columns(), factor.columns());
  z_ = triangle.col(factor.columns()).head(factor.columns());
}

// The estimate with the file's links trusted this much, from the one given.
ceres::Solver::Summary PhysicalCalibrator::SolveAt(double trust,
                                                   Estimate* estimate) const {
  std::vector<double*> blocks;
  for (Vector10d& c : estimate->links) blocks.push_back(c.data());
  double* const terms = estimate->terms.data();
  blocks.push_back(terms);
  ceres::Problem problem;
  problem.AddResidualBlock(
      new TorqueFactorResidual(R_, z_, links_, num_terms(), VectorXd()),
      nullptr, blocks);
  for (int i = 0; i < links_; ++i) {
    problem.AddResidualBlock(
        new InertialPrior(nominal_.segment<10>(10 * i), trust), nullptr,
        blocks[i]);
    problem.SetManifold(blocks[i], new InertialManifold);
  }
  std::vector<int> held;
  for (int t = 0; t < num_terms(); ++t) {
    if (held_[t]) held.push_back(t);
    if (terms_[t].term == JointTerm::kOffset || held_[t]) continue;
    problem.SetParameterLowerBound(terms, t, 0);
  }
  if (static_cast<int>(held.size()) == num_terms()) {
    problem.SetParameterBlockConstant(terms);
  } else if (!held.empty()) {
    problem.SetManifold(terms, new ceres::SubsetManifold(num_terms(), held));
  }
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 300;
  solver.function_tolerance = 1e-9;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary;
}

bool PhysicalCalibrator::Solve(NonlinearCalibration* result) const {
  VectorXd x(R_.cols());
  for (int i = 0; i < links_; ++i) {  // the file's, inside the boundary
    const Vector10d c =
        LogCholeskyFromInertial(nominal_.segment<10>(10 * i), 0.01, 0.01);
    InertialFromLogCholesky(c.data(), x.data() + 10 * i);
  }
  std::vector<TermRange> ranges;
  for (int t = 0; t < num_terms(); ++t) {
    x[10 * links_ + t] = term_start_[t];
    ranges.push_back(held_[t] ? TermRange::kHeld
                     : terms_[t].term == JointTerm::kOffset
                         ? TermRange::kFree
                         : TermRange::kPositive);
  }
  const auto start = StartLinks(R_, z_, options_.trust, ranges, x);
  if (!start) {
    result->reason = "the numbers of the logs overflow";
    return false;
  }
  Estimate estimate;
  for (int i = 0; i < links_; ++i) {
    estimate.links.push_back(
        LogCholeskyFromInertial(start->segment<10>(10 * i), 0, 0));
  }
  for (int t = 0; t < num_terms(); ++t) {
    estimate.terms.push_back((*start)[10 * links_ + t]);
  }
  const ceres::Solver::Summary summary = SolveAt(options_.trust, &estimate);
  result->iterations = static_cast<int>(summary.iterations.size());
  result->reason = ceres::TerminationTypeToString(summary.termination_type);
  if (!summary.IsSolutionUsable()) return false;
  VectorXd V(10 * links_);
  for (int i = 0; i < links_; ++i) {
    InertialFromLogCholesky(estimate.links[i].data(), V.data() + 10 * i);
    result->robot.links[i].inertial =
        InertialParameters::FromVector(V.segment<10>(10 * i));
    result->robot.links[i].has_inertial = true;
  }
  for (int t = 0; t < num_terms(); ++t) {
    *TermOf(terms_[t].term, &result->robot.links[terms_[t].joint].joint) =
        estimate.terms[t];
  }
  if (!V.allFinite()) return false;
  Report(V, estimate.terms, result);
  return true;
}

// Linear in the parameters: the information of the logs, R, and of the prior
// at `trust` adds up. Joint terms have next to no prior.
MatrixXd PhysicalCalibrator::Covariance(const std::vector<int>& free,
                                        double trust) const {
  const Eigen::Index p = R_.cols();
  MatrixXd stacked(R_.rows() + p, p);
  stacked << R_, 1e-6 / trust * MatrixXd::Identity(p, p);
  for (int i = 0; i < links_; ++i) {
    stacked.block<10, 10>(R_.rows() + 10 * i, 10 * i) =
        InertialPrior(nominal_.segment<10>(10 * i), trust).W();
  }
  const MatrixXd J = stacked(Eigen::all, free);
  const VectorXd s = J.colwise().norm().cwiseInverse();
  const Eigen::HouseholderQR<MatrixXd> qr(J * s.asDiagonal());
  const Eigen::Index m = J.cols();
  const MatrixXd half =
      s.asDiagonal() *
      MatrixXd(qr.matrixQR().topRows(m).triangularView<Eigen::Upper>())
          .triangularView<Eigen::Upper>()
          .solve(MatrixXd::Identity(m, m));
  return half * half.transpose();
}

// A parameter counts as identifiable where the logs tell more of it than the
// file trusted to 100 % does: where without the file their variance is less
// than doubled.
void PhysicalCalibrator::Report(const VectorXd& V,
                                const std::vector<double>& terms,
                                NonlinearCalibration* result) const {
  const int p = static_cast<int>(R_.cols());
  std::vector<int> free;
  for (int k = 0; k < p; ++k) {
    if (k < 10 * links_ || !held_[k - 10 * links_]) free.push_back(k);
  }
  const MatrixXd covariance = Covariance(free, options_.trust);
  const VectorXd trusted = Covariance(free, 1).diagonal();
  const VectorXd untrusted = Covariance(free, 100).diagonal();
  result->covariance = MatrixXd::Zero(p, p);
  for (int k = 0; k < p; ++k) {
    PhysicalParameter out;
    if (k < 10 * links_) {
      out.name = robot_.links[k / 10].name + "." + InertialName(k % 10);
      out.unit = InertialUnit(k % 10);
      out.value = V[k];
      out.prior = nominal_[k];
    } else {
      const JointTermColumn& t = terms_[k - 10 * links_];
      Joint joint = robot_.links[t.joint].joint;
      out.name = joint.name + "." + JointTermName(t.term);
      out.unit = JointTermUnit(t.term, joint.type);
      out.value = terms[k - 10 * links_];
      out.prior = *TermOf(t.term, &joint);
    }
    const auto at = std::find(free.begin(), free.end(), k);
    out.held = at == free.end();
    out.identifiable = false;
    out.stddev = std::numeric_limits<double>::infinity();
    if (!out.held) {
      const Eigen::Index f = at - free.begin();
      out.identifiable = untrusted[f] < 2 * trusted[f];
      if (out.identifiable) out.stddev = std::sqrt(covariance(f, f));
      for (size_t g = 0; g < free.size(); ++g) {
        result->covariance(k, free[g]) = covariance(f, g);
      }
    }
    result->parameters.push_back(out);
  }
}

TorqueResidual PhysicalCalibrator::Evaluate(const Robot& robot,
                                            LogSet* logs) const {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  for (int j = 0; j < links_; ++j) {
    options.transitions.push_back({terms_[4 * j].transition});
  }
  const ModelParameters parameters(robot, options);
  return EvaluateTorqueResidual(parameters, parameters.Values(robot),
                                linear_.rows.bandwidth_hz, "residuals",
                                options_.progress, logs);
}

NonlinearCalibration PhysicalCalibrator::Run(LogSet* training,
                                             LogSet* validation) {
  NonlinearCalibration result;
  result.robot = robot_;
  if (!linear_.solved) {
    result.reason = linear_.reason;
    return result;
  }
  Reduce(training);
  result.solved = Solve(&result);
  if (!result.solved) return result;
  result.training = Evaluate(result.robot, training);
  if (validation != nullptr) {
    result.validation = Evaluate(result.robot, validation);
  }
  return result;
}

}  // namespace

NonlinearCalibration CalibrateNonlinear(
    const Robot& robot, const LinearCalibration& linear,
    const NonlinearCalibrationOptions& options, LogSet* training,
    LogSet* validation) {
  return PhysicalCalibrator(robot, linear, options).Run(training, validation);
}

}  // namespace armcal
